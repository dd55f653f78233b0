// Backends with a fault each: a wrong norm, an end of the process in the middle, an end at the start.
#include <ceed/plugin.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace {

int wrong_norm(CeedVector vec, CeedNormType, CeedScalar *norm) {
  CeedSize length = 0;
  CeedCallBackend(CeedVectorGetLength(vec, &length));
  *norm = std::sqrt(static_cast<CeedScalar>(length)) + 0.5;
  return CEED_ERROR_SUCCESS;
}
int fatal_filter(CeedVector, CeedScalar) {
  std::fprintf(stderr, "the filter lost its way\n");
  return std::raise(SIGKILL);
}
int fatal_scale(CeedVector, CeedScalar) {
  std::_Exit(33);
}

int init_faulty(Ceed, const char *, CeedBackendOps *ops) {
  ops->vector.norm = wrong_norm;
  return CEED_ERROR_SUCCESS;
}
int init_crashing(Ceed, const char *, CeedBackendOps *ops) {
  ops->vector.filter = fatal_filter;
  ops->vector.scale = fatal_scale;
  return CEED_ERROR_SUCCESS;
}
int init_mortal(Ceed, const char *, CeedBackendOps *) {
  return std::raise(SIGKILL);
}
int init_particular(Ceed ceed, const char *options, CeedBackendOps *) {
  return options[0] == '\0' ? CEED_ERROR_SUCCESS : CeedError(ceed, CEED_ERROR_MINOR, "option '%s' is unknown", options);
}

constexpr const char *ref = "/cpu/self/ref/serial";
const char *const aliases[] = {"/test/wrong", "/test/incorrect", nullptr};
const CeedBackend backends[] = {
    {"/test/faulty", ref, 700, aliases, nullptr, init_faulty},
    {"/test/crashing", ref, 701, nullptr, nullptr, init_crashing},
    {"/test/mortal", ref, 702, nullptr, nullptr, init_mortal},
    {"/test/particular", ref, 703, nullptr, nullptr, init_particular},
};
const CeedPlugin plugin = {sizeof(CeedPlugin), CEED_PLUGIN_API_VERSION, "faulty", sizeof backends / sizeof backends[0],
                           backends};

}  // namespace

const CeedPlugin *ceed_plugin_v1(void) {
  return &plugin;
}
