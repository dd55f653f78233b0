// Settings of the sanitizers for every program of ours, so that none need be set in the environment.
// The leaks named here are of libraries that keep memory to the end of the process.
__attribute__((visibility("default"), weak)) const char *__asan_default_options(void);  // a program may have its own
__attribute__((visibility("default"))) const char *__lsan_default_options(void);
__attribute__((visibility("default"))) const char *__lsan_default_suppressions(void);
__attribute__((visibility("default"))) const char *__tsan_default_options(void);
__attribute__((visibility("default"))) const char *__ubsan_default_options(void);

// Whole stacks of allocations in programs with MPI, though allocating takes ten times as long with them: MPI unloads its
// modules before the end, and without the callers of a module nothing tells whose a leak is. An allocation that fails is
// an error to report, not the end.
#define CHECKS "detect_stack_use_after_return=1:strict_string_checks=1:allocator_may_return_null=1"
__attribute__((weak)) int MPI_Init(int *argc, char ***argv);
const char *__asan_default_options(void) { return MPI_Init ? CHECKS ":fast_unwind_on_malloc=0" : CHECKS; }

// Tests read what programs write to standard error.
const char *__lsan_default_options(void) { return "print_suppressions=0"; }

const char *__lsan_default_suppressions(void) {
  return "leak:libmpi.so\n"
         "leak:libopen-pal.so\n"
         "leak:libopen-rte.so\n"
         "leak:mca_\n"
         "leak:libpmix\n"
         "leak:libhwloc\n"
         "leak:libevent\n"
         "leak:_dl_map_object\n";  // dlopen() where memory runs out within it
}

const char *__tsan_default_options(void) { return "allocator_may_return_null=1"; }

const char *__ubsan_default_options(void) { return "print_stacktrace=1"; }
