// An array of the program's, used through a vector.
#include <ceed.h>
#include <stdio.h>

int main(int argc, char **argv) {
  Ceed ceed;
  CeedInit(argc > 1 ? argv[1] : "/cpu/self", &ceed);

  // Lent: the vector works on it, wherever that is; the program keeps it alive.
  CeedScalar ours[4] = {1, -2, 3, -4};
  CeedVector x, y;
  CeedVectorCreate(ceed, 4, &x);
  CeedVectorSetArray(x, CEED_MEM_HOST, CEED_USE_POINTER, ours);

  CeedVectorCreate(ceed, 4, &y);
  CeedVectorSetValue(y, 1);
  CeedVectorAXPY(y, 10, x);  // y = 10 x + y

  CeedScalar norm_1, norm_max;
  CeedVectorNorm(x, CEED_NORM_1, &norm_1);
  CeedVectorNorm(x, CEED_NORM_MAX, &norm_max);
  printf("|x|_1 = %g, |x|_max = %g\n", norm_1, norm_max);

  // To look at values, ask for them to read, and give them back.
  const CeedScalar *values;
  CeedVectorGetArrayRead(y, CEED_MEM_HOST, &values);
  printf("y = %g %g %g %g\n", values[0], values[1], values[2], values[3]);
  CeedVectorRestoreArrayRead(y, &values);

  // Who writes alone may leave what was there unread.
  CeedScalar *written;
  CeedVectorGetArrayWrite(x, CEED_MEM_HOST, &written);
  for (int i = 0; i < 4; i++) written[i] = i * i;
  CeedVectorRestoreArray(x, &written);

  // After this, the array holds the values of the vector, which has none left.
  CeedVectorTakeArray(x, CEED_MEM_HOST, NULL);
  printf("ours = %g %g %g %g\n", ours[0], ours[1], ours[2], ours[3]);

  CeedVectorDestroy(&x);
  CeedVectorDestroy(&y);
  CeedDestroy(&ceed);
  return 0;
}
