// Errors that a program looks at, instead of ending at the first.
#include <ceed.h>
#include <stdio.h>
#include <string.h>

// A handler of our own: it gets what vprintf() needs.
static int complain(Ceed ceed, const char *file, int line, const char *function, int code, const char *format,
                    va_list *args) {
  (void)ceed, (void)file, (void)line;
  printf("%s failed: ", function);
  vprintf(format, *args);
  printf("\n");
  return code;
}

int main(int argc, char **argv) {
  Ceed ceed;
  CeedInit(argc > 1 ? argv[1] : "/cpu/self", &ceed);
  CeedVector vector = NULL;
  const char *message;

  // The code says what kind of error it is; the stored message says where, and what was expected.
  CeedSetErrorHandler(ceed, CeedErrorStore);
  const int code = CeedVectorCreate(ceed, -1, &vector);
  CeedGetErrorMessage(ceed, &message);
  printf("code %d, %s\n%s\n", code, CeedErrorTypes[code], strstr(message, "in Ceed"));
  CeedResetErrorMessage(ceed, &message);

  // After an error with a positive code the vector is as it was: it can be restored, and used.
  CeedSetErrorHandler(ceed, complain);
  CeedScalar *array, *second;
  CeedVectorCreate(ceed, 2, &vector);
  CeedVectorSetValue(vector, 1.5);
  CeedVectorGetArray(vector, CEED_MEM_HOST, &array);
  if (CeedVectorGetArray(vector, CEED_MEM_HOST, &second) == CEED_ERROR_ACCESS) printf("the lock is in use\n");
  CeedVectorRestoreArray(vector, &array);

  CeedScalar norm;
  CeedVectorNorm(vector, CEED_NORM_1, &norm);
  printf("norm %g\n", norm);

  CeedVectorDestroy(&vector);
  CeedDestroy(&ceed);
  return 0;
}
