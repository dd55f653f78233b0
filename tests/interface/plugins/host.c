/* Opens the library of its first argument when it runs, as bindings of other languages do; loads the plugin of its second
   one, if there is one; prints the resources, and the error of the load. */
#include <ceed/plugin.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

static void *symbol(void *library, const char *name) {
  void *found = dlsym(library, name);
  if (found == NULL) {
    fprintf(stderr, "%s\n", dlerror());
    exit(2);
  }
  return found;
}

int main(int argc, char **argv) {
  void *library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
  if (library == NULL) {
    fprintf(stderr, "%s\n", dlerror());
    return 2;
  }
  int (*load)(const char *);
  const char *(*load_error)(void);
  int (*get_list)(size_t *, char ***const, CeedInt **);
  *(void **)&load = symbol(library, "CeedPluginLoad");
  *(void **)&load_error = symbol(library, "CeedPluginLoadError");
  *(void **)&get_list = symbol(library, "CeedRegistryGetList");
  if (argc > 2 && load(argv[2]) != 0) printf("error: %s\n", load_error());
  size_t count = 0;
  char **names = NULL;
  if (get_list(&count, &names, NULL) != 0) return 1;
  for (size_t i = 0; i < count; i++) printf("resource: %s\n", names[i]);
  free(names);
  return 0;
}
