#include "ceed.hpp"

#include <cstdlib>
#include <cstring>

#include "registry.hpp"
#include "version.hpp"
#include "view.hpp"

namespace hg {

CeedErrorHandler default_error_handler();
/// Keeps the message that a Ceed has stored, where the Ceed itself does not come to be.
void keep_without_ceed(ErrorStore &errors);

void require_mem_type(const Ceed_private &ceed, CeedMemType mem_type, const char *what) {
  require(mem_type == CEED_MEM_HOST || mem_type == CEED_MEM_DEVICE, CEED_ERROR_MINOR, [&] {
    return text("%s: memory type is %d; expected CEED_MEM_HOST (0) or CEED_MEM_DEVICE (1)", what,
                static_cast<int>(mem_type));
  });
  require(mem_type == CEED_MEM_HOST || !ceed.ops.host_memory_only, CEED_ERROR_BACKEND, [&] {
    return text("%s: Can only provide HOST memory for this backend (%s)", what, ceed.resource.c_str());
  });
}

void require_transpose_mode(CeedTransposeMode t_mode, const char *what, Where where) {
  require(
      t_mode == CEED_NOTRANSPOSE || t_mode == CEED_TRANSPOSE, CEED_ERROR_UNSUPPORTED,
      [&] {
        return text("%s: transpose mode is %d; expected CEED_NOTRANSPOSE (0) or CEED_TRANSPOSE (1)", what,
                    static_cast<int>(t_mode));
      },
      where);
}

}  // namespace hg

Ceed_private::~Ceed_private() {
  hg::destroy_work_vectors(*this);
  if (ops.ceed_destroy != nullptr) ops.ceed_destroy(this);
}

void Ceed_private::view(FILE *stream) const {
  const hg::Lines line(stream, num_view_tabs);
  line(0, "Ceed");
  line(1, "Ceed Resource: %s", resource.c_str());
  line(1, "Preferred MemType: %s", CeedMemTypes[ops.preferred_mem_type]);
}

int CeedInit(const char *resource, Ceed *ceed) {
  return hg::guard(nullptr, [&] {
    hg::require(resource != nullptr, CEED_ERROR_MINOR, "Resource is NULL; expected a name such as \"/cpu/self\"");
    hg::require(ceed != nullptr, CEED_ERROR_MINOR, "Address of the Ceed is NULL; expected where the handle goes");
    std::string_view request = resource;
    if (request.substr(0, request.find(':')) == "help") {
      hg::print_resources(stderr);
      request.remove_prefix(std::min<std::size_t>(request.size(), 5));
    }
    const auto colon = request.find(':');
    const std::string name(request.substr(0, colon));
    const std::string options(colon == std::string_view::npos ? "" : request.substr(colon + 1));
    const CeedBackend &backend = hg::find_backend(name);
    auto created = hg::Ref<Ceed_private>::adopt(new Ceed_private);
    created->error_handler = hg::default_error_handler();
    created->resource = backend.resource;
    try {
      hg::fill_tables(created.get(), backend, options.c_str());
    } catch (...) {
      hg::keep_without_ceed(created->errors);
      throw;
    }
    created->is_deterministic = created->is_deterministic || created->ops.is_deterministic;
    // What *ceed held is overwritten, not destroyed: programs pass handles that they never initialised.
    *ceed = created.release();
  });
}

int CeedReferenceCopy(Ceed ceed, Ceed *ceed_copy) {
  return hg::guard(ceed, [&] { hg::reference_copy(ceed, ceed_copy); });
}

int CeedReference(Ceed ceed) {
  return hg::guard(ceed, [&] { hg::reference(&hg::deref(ceed, "Ceed")); });
}

int CeedDestroy(Ceed *ceed) {
  return hg::guard(nullptr, [&] { hg::destroy(ceed); });
}

int CeedSetStream(Ceed ceed, void *handle) {
  return hg::guard(ceed, [&] {
    const auto set = hg::deref(ceed, "Ceed").ops.ceed_set_stream;
    hg::require(set != nullptr, CEED_ERROR_UNSUPPORTED, [&] {
      return hg::text("Backend does not implement CeedSetStream (%s has no streams)", ceed->resource.c_str());
    });
    hg::check(set(ceed, handle));
  });
}

int CeedGetTransfers(Ceed ceed, CeedTransfers *transfers) {
  return hg::guard(ceed, [&] {
    const auto get = hg::deref(ceed, "Ceed").ops.ceed_get_transfers;
    CeedTransfers counted{};
    if (get != nullptr) hg::check(get(ceed, &counted));
    hg::result(transfers, "transfers") = counted;
  });
}

int CeedGetResource(Ceed ceed, const char **resource) {
  return hg::guard(ceed, [&] { hg::result(resource, "resource") = hg::deref(ceed, "Ceed").resource.c_str(); });
}

int CeedGetResourceRoot(Ceed ceed, const char *resource, const char *delineator, char **resource_root) {
  return hg::guard(ceed, [&] {
    hg::require(resource != nullptr && delineator != nullptr, CEED_ERROR_MINOR,
                "An argument is NULL; expected a resource and the delineator that ends its root");
    hg::require_argument(resource_root, "resource_root (where the text goes)");
    const std::string_view whole = resource;
    const std::string root(whole.substr(0, whole.find(delineator)));
    *resource_root = ::strdup(root.c_str());
    if (*resource_root == nullptr) throw std::bad_alloc();
  });
}

int CeedIsDeterministic(Ceed ceed, bool *is_deterministic) {
  return hg::guard(
      ceed, [&] { hg::result(is_deterministic, "is_deterministic") = hg::deref(ceed, "Ceed").is_deterministic; });
}

int CeedSetDeterministic(Ceed ceed, bool is_deterministic) {
  return hg::guard(ceed, [&] { hg::deref(ceed, "Ceed").is_deterministic = is_deterministic; });
}

int CeedSetNumViewTabs(Ceed ceed, CeedInt num_tabs) {
  return hg::set_view_tabs(ceed, num_tabs);
}

int CeedGetNumViewTabs(Ceed ceed, CeedInt *num_tabs) {
  return hg::get_view_tabs(ceed, num_tabs);
}

int CeedView(Ceed ceed, FILE *stream) {
  return hg::view_object(ceed, stream);
}

int CeedGetVersion(int *major, int *minor, int *patch, bool *release) {
  if (major != nullptr) *major = CEED_VERSION_MAJOR;
  if (minor != nullptr) *minor = CEED_VERSION_MINOR;
  if (patch != nullptr) *patch = CEED_VERSION_PATCH;
  if (release != nullptr) *release = CEED_VERSION_RELEASE;
  return CEED_ERROR_SUCCESS;
}

int CeedGetGitVersion(const char **git_version) {
  return hg::guard(nullptr, [&] { hg::result(git_version, "git_version") = hg::git_version; });
}

int CeedGetBuildConfiguration(const char **build_config) {
  return hg::guard(nullptr, [&] { hg::result(build_config, "build_config") = hg::build_configuration; });
}

int CeedSetIsClang(Ceed ceed, bool isClang) {
  return hg::guard(ceed, [&] { hg::deref(ceed, "Ceed").is_clang = isClang; });
}

int CeedGetIsClang(Ceed ceed, bool *isClang) {
  return hg::guard(ceed, [&] { hg::result(isClang, "isClang") = hg::deref(ceed, "Ceed").is_clang; });
}

int CeedGetScalarType(CeedScalarType *scalar_type) {
  return hg::guard(nullptr, [&] { hg::result(scalar_type, "scalar_type") = CEED_SCALAR_TYPE; });
}

int CeedGetPreferredMemType(Ceed ceed, CeedMemType *type) {
  return hg::guard(ceed, [&] { hg::result(type, "type") = hg::deref(ceed, "Ceed").ops.preferred_mem_type; });
}

int CeedIsDebug(Ceed ceed, bool *is_debug) {
  return hg::guard(ceed, [&] {
    hg::result(is_debug, "is_debug") = std::getenv("CEED_DEBUG") != nullptr || std::getenv("DEBUG") != nullptr;
  });
}

int CeedGetBackendOps(Ceed ceed, const CeedBackendOps **ops) {
  return hg::guard(ceed, [&] { hg::result(ops, "ops") = &hg::deref(ceed, "Ceed").ops; });
}

int CeedGetData(Ceed ceed, void *data) {
  return hg::guard(ceed, [&] { hg::result(static_cast<void **>(data), "data") = hg::deref(ceed, "Ceed").data; });
}

int CeedSetData(Ceed ceed, void *data) {
  return hg::guard(ceed, [&] { hg::deref(ceed, "Ceed").data = data; });
}
