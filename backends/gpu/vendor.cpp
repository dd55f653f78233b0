#include "vendor.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <system_error>

#include "../jit/cache.hpp"
#include "../jit/tell.hpp"
#include "texts.hpp"

namespace hg::gpu {

VendorLibrary::VendorLibrary(std::span<const char *const> files) {
  std::string why;
  for (const char *file : files) {
    library_ = ::dlopen(file, RTLD_NOW | RTLD_LOCAL);
    file_ = file;
    if (library_ != nullptr) return;
    const char *error = ::dlerror();
    const std::string reason = error != nullptr ? error : std::string(file) + " cannot be loaded";
    // A file that is there, and cannot be loaded, says more than one that is not.
    if (why.empty() || reason.find("No such file") == std::string::npos) why = reason;
  }
  throw DeviceError(why);
}

void *VendorLibrary::symbol(const char *name) const {
  void *address = ::dlsym(library_, name);
  if (address == nullptr) throw DeviceError("the library " + file_ + " has no function " + name);
  return address;
}

VendorCompiler::VendorCompiler(const Vendor &vendor)
    : vendor_(vendor), calls_(VendorLibrary(vendor.compiler_files).calls<CompilerCalls>(vendor.compiler_names)) {
  int major = 0, minor = 0;
  calls_.version(&major, &minor);
  version_ = std::to_string(major) + '.' + std::to_string(minor);
  // That may be the interface's: the file tells one compiler from the next.
  Dl_info library;
  std::error_code error;
  if (::dladdr(reinterpret_cast<void *>(calls_.version), &library) != 0) {
    const std::filesystem::path file = library.dli_fname;
    version_ += ' ' + std::to_string(std::filesystem::file_size(file, error)) + ' ' +
                std::to_string(std::filesystem::last_write_time(file, error).time_since_epoch().count());
  }
}

std::string VendorCompiler::compile(const std::string &name, const std::string &text,
                                    const std::vector<std::string> &options, std::string *log, bool is_usable) const {
  std::string all = std::string(vendor_.name) + ' ' + version_ + '\n';
  for (const auto &option : options) all += option + '\n';
  std::optional<jit::Cache> cache;
  try {
    cache.emplace();
  } catch (const jit::NotCompiled &reason) {
    jit::tell_once("no cache", std::string("what is compiled for devices is not kept: ") + reason.what());
    return compile_now(name, text, options, log);
  }
  return cache->code(
      all + jit::text_of(texts, "vendors.hpp") + text, [&] { return compile_now(name, text, options, log); },
      is_usable);
}

std::string VendorCompiler::compile_now(const std::string &name, const std::string &text,
                                        const std::vector<std::string> &options, std::string *log) const {
  const std::string whole = jit::text_of(texts, "vendors.hpp") + text;
  const auto check = [&](int code, const std::string &what) {
    if (code != 0) throw DeviceError(what + ": " + calls_.error(code));
  };
  void *created = nullptr;
  check(calls_.create(&created, whole.c_str(), (name + ".cu").c_str(), 0, nullptr, nullptr), "'" + name + "'");
  const auto destroy = [this](void *program) { calls_.destroy(&program); };
  const std::unique_ptr<void, decltype(destroy)> program(created, destroy);
  std::vector<const char *> words;
  for (const auto &option : options) words.push_back(option.c_str());
  const int code = calls_.compile(program.get(), static_cast<int>(words.size()), words.data());
  std::size_t bytes = 0;
  std::string said;
  if (calls_.log_size(program.get(), &bytes) == 0 && bytes > 1) {
    said.resize(bytes);
    calls_.log(program.get(), said.data());
    said.resize(std::strlen(said.c_str()));
  }
  if (log != nullptr) *log = said;
  check(code, "'" + name + "' is not compiled: the compiler refuses it:\n" + said);
  check(calls_.code_size(program.get(), &bytes), "'" + name + "'");
  std::string compiled(bytes, '\0');
  check(calls_.code(program.get(), compiled.data()), "'" + name + "'");
  return compiled;
}

namespace {

void check_call(const Vendor &vendor, const VendorLibrary &library, int code, const std::string &what) {
  if (code != 0) throw DeviceError(std::string(vendor.name) + ": " + what + ": " + vendor.error(library, code));
}

/// Number of devices, at least one. Throws DeviceError where there is none.
int count_devices(const Vendor &vendor, const VendorLibrary &library, const DriverCalls &calls) {
  int count = 0;
  check_call(vendor, library, calls.init(0), "it does not start");
  check_call(vendor, library, calls.count_devices(&count), "devices cannot be counted");
  if (count == 0) throw DeviceError(std::string(vendor.name) + ": there is no device");
  return count;
}

class VendorDriver : public Driver {
 public:
  VendorDriver(const Vendor &vendor, int device);
  VendorDriver(const VendorDriver &) = delete;
  VendorDriver &operator=(const VendorDriver &) = delete;
  ~VendorDriver() override;

  const Properties &properties() const override { return properties_; }
  void *allocate(std::size_t bytes) override;
  void free(void *memory) noexcept override;
  void copy(void *to, const void *from, std::size_t bytes) override;
  void clear(void *memory, std::size_t bytes) override;
  void set_stream(void *stream) override;
  std::unique_ptr<Module> compile(const std::string &name, const std::string &text) override;
  void launch(Kernel kernel, const Launch &launch, const void *job, std::size_t job_bytes) override;
  void launch_user(void *kernel, void *context, CeedInt Q, const UserFields &fields) override;
  std::unique_ptr<Calls> make_calls() override;

 private:
  friend class VendorModule;
  friend class VendorGraph;
  void to_device(void *to, const void *from, std::size_t bytes) override;
  void to_host(void *to, const void *from, std::size_t bytes) override;
  /// What failed is told by `what`: a text, or a function that makes one, since most calls are right.
  void check(int code, const char *what) const {
    if (code != 0) check_call(vendor_, library_, code, what);
  }
  template <typename F>
  void check(int code, const F &what) const {
    if (code != 0) check_call(vendor_, library_, code, what());
  }
  void make_current() const { check(vendor_.make_current(library_, handle_), "the device cannot be used"); }
  /// Throws where a launch is beyond what the vendor's calls take.
  void allow(Kernel kernel, const Launch &launch) const;

  const Vendor &vendor_;
  VendorLibrary library_;
  DriverCalls calls_;
  VendorCompiler compiler_;
  Properties properties_;
  std::vector<std::string> options_;
  void *handle_ = nullptr;
  std::atomic<void *> stream_ = nullptr;
  void *left_ = nullptr;  ///< the event that the stream before is done; NULL: no stream was left yet
};

/// Code that the driver refuses.
struct NotLoaded : DeviceError {
  using DeviceError::DeviceError;
};

class VendorModule : public Module {
 public:
  /// Throws NotLoaded.
  VendorModule(const VendorDriver &driver, std::string name, const std::string &code)
      : driver_(driver), name_(std::move(name)) {
    const int error = driver_.calls_.load(&module_, code.data());
    if (error != 0) {
      throw NotLoaded(std::string(driver_.vendor_.name) + ": '" + name_ +
                      "' cannot be loaded: " + driver_.vendor_.error(driver_.library_, error));
    }
  }
  VendorModule(const VendorModule &) = delete;
  VendorModule &operator=(const VendorModule &) = delete;
  ~VendorModule() override {
    driver_.vendor_.make_current(driver_.library_, driver_.handle_);
    driver_.calls_.unload(module_);
  }
  Kernel kernel(const char *name) override {
    static std::atomic<std::uint64_t> count = 0;
    Kernel kernel{.handle = nullptr, .id = ++count, .name = name_.c_str()};
    driver_.make_current();
    driver_.check(driver_.calls_.function(&kernel.handle, module_, name),
                  [&] { return "'" + name_ + "' has no kernel '" + name + "'"; });
    return kernel;
  }

 private:
  const VendorDriver &driver_;
  std::string name_;
  void *module_ = nullptr;
};

VendorDriver::VendorDriver(const Vendor &vendor, int device)
    : vendor_(vendor),
      library_(vendor.driver_files),
      calls_(library_.calls<DriverCalls>(vendor.driver_names)),
      compiler_(vendor) {
  const int count = count_devices(vendor, library_, calls_);
  if (device == current_device) check(vendor.current(library_, &device), "no device is the current one");
  if (device >= count) {
    throw DeviceError(std::string(vendor.name) + ": there is no device_id=" + std::to_string(device) +
                      "; expected 0 to " + std::to_string(count - 1));
  }
  check(vendor.open(library_, device, &handle_), "the device cannot be opened");
  make_current();
  char name[256] = "";
  check(calls_.name(name, sizeof name - 1, device), "the device has no name");
  const auto attribute = [&](int number) {
    int value = 0;
    check(calls_.attribute(&value, number, device), "the device does not say what it is");
    return value;
  };
  properties_ = {.name = name,
                 .number = device,
                 .warp_size = attribute(vendor.attributes.warp_size),
                 .max_threads = attribute(vendor.attributes.max_threads),
                 .shared_per_block = static_cast<std::size_t>(attribute(vendor.attributes.shared_per_block)),
                 .num_processors = attribute(vendor.attributes.num_processors),
                 .user_kernels = vendor.user_kernels};
  options_ = vendor.options(calls_, device);
}

VendorDriver::~VendorDriver() {
  vendor_.make_current(library_, handle_);
  if (left_ != nullptr) calls_.destroy_event(left_);
}

void *VendorDriver::allocate(std::size_t bytes) {
  void *memory = nullptr;
  make_current();
  const int code = calls_.allocate(&memory, bytes == 0 ? 1 : bytes);
  constexpr int out_of_memory = 2;  // in both
  if (code == out_of_memory) {
    throw DeviceError("Out of memory: '" + properties_.name + "' has no room for " + std::to_string(bytes) + " bytes");
  }
  check(code, [&] { return std::to_string(bytes) + " bytes cannot be allocated"; });
  return memory;
}

void VendorDriver::free(void *memory) noexcept {
  vendor_.make_current(library_, handle_);
  calls_.free(memory);
}

void VendorDriver::to_device(void *to, const void *from, std::size_t bytes) {
  const auto what = [&] { return "a copy of " + std::to_string(bytes) + " bytes to the device failed"; };
  make_current();
  check(calls_.to_device(to, from, bytes, stream_), what);
  check(calls_.synchronize(stream_), what);  // `from` may change when this returns
}

void VendorDriver::to_host(void *to, const void *from, std::size_t bytes) {
  make_current();
  check(calls_.to_host(to, from, bytes, stream_),
        [&] { return "a copy of " + std::to_string(bytes) + " bytes to the host failed"; });
  check(calls_.synchronize(stream_), "work on the device failed");
}

void VendorDriver::copy(void *to, const void *from, std::size_t bytes) {
  if (bytes == 0) return;
  make_current();
  check(calls_.copy(to, from, bytes, stream_),
        [&] { return "a copy of " + std::to_string(bytes) + " bytes on the device failed"; });
}

void VendorDriver::clear(void *memory, std::size_t bytes) {
  if (bytes == 0) return;
  make_current();
  check(calls_.clear(memory, 0, bytes, stream_), [&] { return std::to_string(bytes) + " bytes cannot be cleared"; });
}

void VendorDriver::set_stream(void *stream) {
  if (stream == stream_) return;
  make_current();
  constexpr unsigned without_time = 2;  // in both
  if (left_ == nullptr) check(calls_.create_event(&left_, without_time), "there is no event");
  // What comes next reads what was written there.
  check(calls_.record(left_, stream_), "the stream before is not there any more");
  check(calls_.wait(stream, left_, 0), "the stream cannot wait for the one before");
  stream_ = stream;
}

std::unique_ptr<Module> VendorDriver::compile(const std::string &name, const std::string &text) {
  make_current();
  if (vendor_.options_have_architecture) {
    return std::make_unique<VendorModule>(*this, name, compiler_.compile(name, text, options_));
  }
  // The device's name is a part of the text then, by which code is found again. What another device of this name left
  // there need not load.
  const std::string for_device = "// " + properties_.name + '\n' + text;
  try {
    return std::make_unique<VendorModule>(*this, name, compiler_.compile(name, for_device, options_));
  } catch (const NotLoaded &) {
    return std::make_unique<VendorModule>(*this, name, compiler_.compile(name, for_device, options_, nullptr, false));
  }
}

void VendorDriver::allow(Kernel kernel, const Launch &launch) const {
  if (launch.num_blocks > most_blocks) {
    throw DeviceError(std::string(vendor_.name) + ": '" + kernel.name + "' is launched with " +
                      std::to_string(launch.num_blocks) + " blocks; expected " + std::to_string(most_blocks) +
                      " at most");
  }
  make_current();
  constexpr std::size_t usual_shared = 48 << 10;
  if (launch.shared_bytes > usual_shared) {
    check(vendor_.allow_shared(library_, kernel.handle, launch.shared_bytes), [&] {
      return std::string("a block of '") + kernel.name + "' cannot have its " + std::to_string(launch.shared_bytes) +
             " bytes of shared memory";
    });
  }
}

void VendorDriver::launch(Kernel kernel, const Launch &launch, const void *job, std::size_t) {
  allow(kernel, launch);
  void *arguments[] = {const_cast<void *>(job)};
  check(calls_.launch(kernel.handle, static_cast<unsigned>(launch.num_blocks), 1, 1,
                      static_cast<unsigned>(launch.num_threads), 1, 1, static_cast<unsigned>(launch.shared_bytes),
                      stream_, arguments, nullptr),
        [&] { return std::string("'") + kernel.name + "' cannot be launched"; });
}

void VendorDriver::launch_user(void *kernel, void *context, CeedInt Q, const UserFields &fields) {
  if (Q == 0) return;
  constexpr unsigned num_threads = usual_threads;
  make_current();
  void *arguments[] = {&context, &Q, const_cast<UserFields *>(&fields)};
  check(calls_.launch(kernel, (static_cast<unsigned>(Q) + num_threads - 1) / num_threads, 1, 1, num_threads, 1, 1, 0,
                      stream_, arguments, nullptr),
        "the user's kernel cannot be launched");
}

/// One graph without dependencies. It is made anew where other kernels are called; where only their jobs have changed,
/// those of its nodes are exchanged. Kernels that the vendor's library takes into no graph are launched one by one.
class VendorGraph : public Calls {
 public:
  /// Throws DeviceError where the library, older than the compiler, has no graphs.
  explicit VendorGraph(VendorDriver &driver)
      : driver_(driver), calls_(driver.library_.calls<GraphCalls>(driver.vendor_.graph_names)) {}
  VendorGraph(const VendorGraph &) = delete;
  VendorGraph &operator=(const VendorGraph &) = delete;
  ~VendorGraph() override {
    driver_.vendor_.make_current(driver_.library_, driver_.handle_);
    destroy();
  }

  void launch(std::span<const Call> calls) override {
    for (const Call &call : calls) driver_.allow(call.kernel, call.launch);
    const auto is_of_kernel = [](const Call &a, const Call &b) { return a.kernel.id == b.kernel.id; };
    if (!std::equal(calls.begin(), calls.end(), calls_made_.begin(), calls_made_.end(), is_of_kernel)) make(calls);
    if (executable_ == nullptr) {
      for (const Call &call : calls) driver_.make(call);
      return;
    }
    for (std::size_t i = 0; i < calls.size(); i++) {
      const Call &now = calls[i], &then = calls_made_[i];
      if (now.job == then.job && now.launch == then.launch) continue;
      with_node(now, [&](const GraphNode &node) {
        driver_.check(calls_.change(executable_, nodes_[i], &node),
                      [&] { return std::string("'") + now.kernel.name + "' cannot be changed in its graph"; });
      });
      calls_made_[i] = now;
    }
    driver_.check(calls_.launch(executable_, driver_.stream_), [&] {
      return "the graph of " + std::to_string(calls.size()) + " kernels, the first of which is '" +
             calls[0].kernel.name + "', cannot be launched";
    });
  }
  std::size_t num_bytes() const override {
    std::size_t bytes = sizeof *this;
    for (const Call &call : calls_made_) bytes += sizeof call + call.job.size();
    return bytes;
  }

 private:
  /// The arguments are copied by who gets them.
  template <typename F>
  void with_node(const Call &call, F &&f) const {
    void *arguments[] = {const_cast<std::byte *>(call.job.data())};
    f(driver_.vendor_.graph_node({.function = call.kernel.handle,
                                  .num_blocks = static_cast<unsigned>(call.launch.num_blocks),
                                  .num_threads = static_cast<unsigned>(call.launch.num_threads),
                                  .shared_bytes = static_cast<unsigned>(call.launch.shared_bytes),
                                  .arguments = arguments}));
  }
  /// There is no executable where the vendor's library refuses it.
  void make(std::span<const Call> calls) {
    destroy();
    bool is_taken = calls_.create(&graph_, 0) == 0;
    for (const Call &call : calls) {
      if (!is_taken) break;
      with_node(call, [&](const GraphNode &node) {
        is_taken = calls_.add(&nodes_.emplace_back(), graph_, nullptr, 0, &node) == 0;
      });
    }
    if (is_taken && calls_.make(&executable_, graph_, 0) != 0) executable_ = nullptr;
    calls_made_.assign(calls.begin(), calls.end());
  }
  void destroy() {
    if (executable_ != nullptr) calls_.destroy_executable(executable_);
    if (graph_ != nullptr) calls_.destroy(graph_);
    executable_ = graph_ = nullptr;
    nodes_.clear();
    calls_made_.clear();
  }

  VendorDriver &driver_;
  GraphCalls calls_;
  void *graph_ = nullptr, *executable_ = nullptr;
  std::vector<void *> nodes_;
  std::vector<Call> calls_made_;
};

std::unique_ptr<Calls> VendorDriver::make_calls() {
  try {
    return std::make_unique<VendorGraph>(*this);
  } catch (const DeviceError &) {
    return Driver::make_calls();
  }
}

}  // namespace

std::shared_ptr<Driver> make_driver(const Vendor &vendor, int device) {
  return std::make_shared<VendorDriver>(vendor, device);
}

int score_of(const Vendor &vendor, const char **reason) {
  static std::mutex mutex;
  static std::map<std::string, std::string> reasons;  // they are pointed to
  const std::scoped_lock one_thread(mutex);
  try {
    const VendorLibrary library(vendor.driver_files);
    count_devices(vendor, library, library.calls<DriverCalls>(vendor.driver_names));
    const VendorCompiler compiler(vendor);
    return 1;
  } catch (const DeviceError &error) {
    *reason = (reasons[vendor.name] = error.what()).c_str();
    return 0;
  }
}

}  // namespace hg::gpu
