// A plugin that loads, whose backends do not open: on no machine, or with an error of one kind or another.
#include <ceed/plugin.h>

#include <stdexcept>

namespace {

int score_zero(const char **reason) {
  *reason = "no such device in this machine";
  return 0;
}
int score_throws(const char **) {
  throw std::runtime_error("the driver is of another year");
}
int score_throws_odd(const char **) {
  throw 42;
}
int never(Ceed, const char *, CeedBackendOps *) {
  throw std::logic_error("init of a backend with score 0");
}
int fails(Ceed ceed, const char *, CeedBackendOps *) {
  return CeedError(ceed, CEED_ERROR_BACKEND, "the driver said %d", 77);
}
int throws(Ceed, const char *, CeedBackendOps *) {
  throw std::runtime_error("out of streams");
}
int throws_odd(Ceed, const char *, CeedBackendOps *) {
  throw 42;
}
int works(Ceed, const char *, CeedBackendOps *) {
  return CEED_ERROR_SUCCESS;
}

constexpr const char *ref = "/cpu/self/ref/serial";
const CeedBackend backends[] = {
    {"/test/absent", ref, 1, nullptr, score_zero, never},
    {"/test/unsure", ref, 1, nullptr, score_throws, never},
    {"/test/unsure oddly", ref, 1, nullptr, score_throws_odd, never},
    {"/test/failing", ref, 1, nullptr, nullptr, fails},
    {"/test/throwing", ref, 1, nullptr, nullptr, throws},
    {"/test/throwing oddly", ref, 1, nullptr, nullptr, throws_odd},
    {"/test/orphan", "/test/no such parent", 1, nullptr, nullptr, works},
    {"/test/hen", "/test/egg", 1, nullptr, nullptr, works},
    {"/test/egg", "/test/hen", 1, nullptr, nullptr, works},
    {"/test/empty", nullptr, 1, nullptr, nullptr, works},
    {"/test/choice/absent", ref, 1, nullptr, score_zero, never},
    {"/test/choice/present", ref, 50, nullptr, nullptr, works},
};
const CeedPlugin plugin = {sizeof(CeedPlugin), CEED_PLUGIN_API_VERSION, "troubled",
                           sizeof backends / sizeof backends[0], backends};

}  // namespace

const CeedPlugin *ceed_plugin_v1(void) {
  return &plugin;
}
