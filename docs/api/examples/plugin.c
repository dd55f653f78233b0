// A backend within a program: the reference, but it counts the vectors that are made.
#include <ceed/plugin.h>
#include <stdio.h>

static int (*create_of_parent)(CeedVector vec);
static int num_vectors;

static int count_and_create(CeedVector vec) {
  num_vectors++;
  return create_of_parent(vec);
}

// `ops` is a copy of the parent's tables; what is not changed here, the parent does.
static int init(Ceed ceed, const char *options, CeedBackendOps *ops) {
  (void)ceed, (void)options;
  create_of_parent = ops->vector.create;
  ops->vector.create = count_and_create;
  return CEED_ERROR_SUCCESS;
}

static const CeedBackend backends[] = {{
    .resource = "/cpu/self/counting",
    .parent = "/cpu/self/ref/serial",
    .priority = 1000,
    .init = init,
}};
static const CeedPlugin plugin = {
    .size = sizeof(CeedPlugin),
    .api_version = CEED_PLUGIN_API_VERSION,
    .name = "counting",
    .num_backends = 1,
    .backends = backends,
};

int main(void) {
  CeedPluginRegister(&plugin);
  Ceed ceed;
  CeedInit("/cpu/self/counting", &ceed);

  const char *resource;
  CeedGetResource(ceed, &resource);
  const CeedInt offsets[] = {0, 1, 1, 2};
  CeedElemRestriction restriction;
  CeedVector l_vector, e_vector;
  CeedElemRestrictionCreate(ceed, 2, 2, 1, 1, 3, CEED_MEM_HOST, CEED_COPY_VALUES, offsets, &restriction);
  CeedElemRestrictionCreateVector(restriction, &l_vector, &e_vector);
  printf("%s made %d vectors\n", resource, num_vectors);

  CeedVectorDestroy(&l_vector);
  CeedVectorDestroy(&e_vector);
  CeedElemRestrictionDestroy(&restriction);
  CeedDestroy(&ceed);
  return 0;
}
