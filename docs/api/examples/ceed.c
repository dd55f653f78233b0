// What the library offers, and what one resource leads to.
#include <ceed.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(int argc, char **argv) {
  Ceed ceed;
  CeedInit(argc > 1 ? argv[1] : "/cpu/self/ref", &ceed);

  int major, minor;
  CeedScalarType precision;
  CeedGetVersion(&major, &minor, NULL, NULL);
  CeedGetScalarType(&precision);
  printf("interface %d.%d, %s precision\n", major, minor, precision == CEED_SCALAR_FP64 ? "double" : "single");

  const char *resource;
  CeedMemType mem_type;
  bool is_deterministic;
  CeedGetResource(ceed, &resource);
  CeedGetPreferredMemType(ceed, &mem_type);
  CeedIsDeterministic(ceed, &is_deterministic);
  printf("works in %s memory, %s\n", CeedMemTypes[mem_type], is_deterministic ? "deterministic" : "not deterministic");

  // All names that CeedInit() knows, ours among them.
  size_t num_resources;
  char **resources;
  CeedRegistryGetList(&num_resources, &resources, NULL);
  for (size_t i = 0; i < num_resources; i++) {
    if (strcmp(resources[i], resource) == 0) printf("is in the registry\n");
  }
  free(resources);

  CeedDestroy(&ceed);
  return 0;
}
