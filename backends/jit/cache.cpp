#include "cache.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>
#include <system_error>

#include "tell.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace hg::jit {

namespace fs = std::filesystem;

namespace {

std::string reason(int error) {
  return std::generic_category().message(error);
}

fs::path chosen_folder() {
  const auto variable = [](const char *name) {
    const char *value = std::getenv(name);
    return fs::path(value != nullptr ? value : "");
  };
  if (const fs::path folder = variable("CEED_CACHE_DIR"); !folder.empty()) return folder;
  if (const fs::path folder = variable("XDG_CACHE_HOME"); !folder.empty()) return folder / "honeyguide";
  if (const fs::path folder = variable("HOME"); !folder.empty()) return folder / ".cache" / "honeyguide";
  throw NotCompiled(
      "there is no folder for compiled libraries: neither CEED_CACHE_DIR nor XDG_CACHE_HOME nor HOME is set");
}

std::uintmax_t largest_size() {
  constexpr std::uintmax_t mebibyte = 1 << 20, usual = 512;
  const char *value = std::getenv("CEED_CACHE_SIZE");
  if (value == nullptr || *value == '\0') return usual * mebibyte;
  char *end = nullptr;
  const double size = std::strtod(value, &end);
  if (*end != '\0' || !(size >= 0)) {
    throw NotCompiled("CEED_CACHE_SIZE is '" + std::string(value) + "'; expected a number of MiB");
  }
  return static_cast<std::uintmax_t>(std::min(size, 1e9) * mebibyte);
}

/// A name that no other process or thread has.
std::string own(const std::string &name) {
  static std::atomic<unsigned> count{0};
  return name + '.' + std::to_string(::getpid()) + '.' + std::to_string(count++);
}

/// A file of this process's own, which is gone in the end.
class Passing {
 public:
  explicit Passing(fs::path path) : path_(std::move(path)) {}
  Passing(const Passing &) = delete;
  Passing &operator=(const Passing &) = delete;
  ~Passing() { ::unlink(path_.c_str()); }
  const fs::path &path() const { return path_; }
  void become(const fs::path &name) const {
    ::chmod(path_.c_str(), 0600);  // whatever the umask is
    if (::rename(path_.c_str(), name.c_str()) != 0) {
      throw NotCompiled("'" + name.string() + "' cannot be written: " + reason(errno));
    }
  }

 private:
  fs::path path_;
};

/// One process at a time between its ends; where the file system has no locks, several do the same work.
class Lock {
 public:
  explicit Lock(fs::path path) : path_(std::move(path)) {
    file_ = ::open(path_.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
    while (file_ >= 0 && ::flock(file_, LOCK_EX) != 0 && errno == EINTR) {
    }
  }
  Lock(const Lock &) = delete;
  Lock &operator=(const Lock &) = delete;
  ~Lock() {
    ::unlink(path_.c_str());
    if (file_ >= 0) ::close(file_);
  }

 private:
  fs::path path_;
  int file_ = -1;
};

/// The files of an entry: the library, its text, what the compiler said where that was wanted.
fs::path with(fs::path entry, const char *extension) {
  return entry.replace_extension(extension);
}

std::string text_in(const fs::path &file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

bool is_there(const fs::path &file) {
  return ::access(file.c_str(), F_OK) == 0;
}

/// Whether a library goes on to the table of its sections, which is the end of it. The loader does not look, and the
/// process that loads one which a crash of the machine cut short is ended by a signal.
bool is_whole(const fs::path &library) {
#if defined(__ELF__)
  ElfW(Ehdr) header{};
  std::ifstream stream(library, std::ios::binary);
  if (!stream.read(reinterpret_cast<char *>(&header), sizeof header)) return false;
  std::error_code ignored;
  return fs::file_size(library, ignored) >= header.e_shoff + std::uintmax_t{header.e_shnum} * header.e_shentsize;
#else
  return is_there(library);
#endif
}

}  // namespace

std::string digest(const std::string &text) {
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  XXH128_canonical_t bytes;
  XXH128_canonicalFromHash(&bytes, hash);
  std::string hex;
  for (const unsigned char byte : bytes.digest) {
    for (const int nibble : {byte >> 4, byte & 15}) hex += "0123456789abcdef"[nibble];
  }
  return hex;
}

Cache::Cache() : folder_(chosen_folder()), largest_(largest_size()) {
  std::error_code failure;
  fs::create_directories(folder_.parent_path(), failure);
  if (::mkdir(folder_.c_str(), 0700) != 0 && errno != EEXIST) {
    throw NotCompiled("the folder '" + folder_.string() + "' cannot be made: " + reason(errno) +
                      "; CEED_CACHE_DIR names another one");
  }
  struct stat facts {};
  if (::stat(folder_.c_str(), &facts) != 0 || !S_ISDIR(facts.st_mode)) {
    throw NotCompiled("'" + folder_.string() + "' is no folder");
  }
  if (facts.st_uid != ::geteuid() || (facts.st_mode & (S_IWGRP | S_IWOTH)) != 0) {
    throw NotCompiled("what is in '" + folder_.string() +
                      "' is not to be trusted: expected a folder of this user's own in which no one else may write");
  }
  folder_ = fs::canonical(folder_, failure);
}

void Cache::keep(const fs::path &name, const std::string &text) const {
  const fs::path file = folder_ / name;
  std::error_code failure;
  if (fs::file_size(file, failure) == text.size()) return;  // a crash of the machine may have cut it short
  fs::path folder = folder_;
  for (const fs::path &part : name.parent_path()) ::mkdir((folder /= part).c_str(), 0700);
  const Passing passing(own(file));
  std::ofstream stream(passing.path());
  stream << text << std::flush;
  if (!stream) throw NotCompiled("'" + file.string() + "' cannot be written: " + reason(errno));
  passing.become(file);
}

void *Cache::library(const Compiler &compiler, const Request &request, std::string *said) const {
  std::string all =
      compiler.identity() + '\n' + request.depends_on + '\n' + (request.is_report_wanted ? "report\n" : "\n");
  for (const auto &option : request.options) all += option + '\n';
  const std::string name = digest(all + request.text);
  const fs::path file = folder_ / (name + ".so");
  static std::mutex mutex;
  static std::map<std::string, void *> opened;  // libraries stay open: operators come and go
  const std::scoped_lock one_thread(mutex);
  if (const auto found = opened.find(file); found != opened.end()) return found->second;
  // What is there may be cut short, and what was there a moment ago may be gone, as room for another process's entry.
  for (int attempts_left = 2;; attempts_left--) {
    const bool is_found = is_whole(file);
    if (is_found) {
      ::utimensat(AT_FDCWD, file.c_str(), nullptr, 0);  // was used now
      if (request.is_report_wanted) *said = text_in(with(file, ".txt"));
    } else {
      compile(compiler, request, name, said);
    }
    if (void *library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL); library != nullptr) {
      opened.emplace(file, library);
      return library;
    }
    const char *error = ::dlerror();
    const bool is_gone = ::unlink(file.c_str()) != 0;
    if (attempts_left == 0 || (!is_found && !is_gone)) {
      throw NotCompiled("'" + file.string() + "' cannot be loaded: " + (error != nullptr ? error : "no reason given"));
    }
  }
}

// A file is the code and its digest, so that one that was cut short is seen.
std::string Cache::code(const std::string &request, const std::function<std::string()> &make, bool is_usable) const {
  const std::string name = digest(request);
  const fs::path file = folder_ / (name + ".bin");
  const std::size_t digest_size = name.size();
  const auto stored = [&] {
    std::string text = text_in(file);
    if (text.size() < digest_size) return std::string();
    const std::string own = text.substr(text.size() - digest_size);
    text.resize(text.size() - digest_size);
    return digest(text) == own ? text : std::string();
  };
  if (!is_usable) ::unlink(file.c_str());
  if (std::string code = stored(); !code.empty()) {
    ::utimensat(AT_FDCWD, file.c_str(), nullptr, 0);  // was used now
    return code;
  }
  const Lock one_process(folder_ / (name + ".lock"));
  if (std::string code = stored(); !code.empty()) return code;
  std::string code = make();
  ::unlink(file.c_str());
  try {
    keep(file.filename(), code + digest(code));
    trim();
  } catch (const NotCompiled &reason) {
    tell_once("not kept", std::string("what is compiled for devices is not kept: ") + reason.what());
  }
  return code;
}

void Cache::compile(const Compiler &compiler, const Request &request, const std::string &name,
                    std::string *said) const {
  const Lock one_process(folder_ / (name + ".lock"));
  const fs::path source = folder_ / (name + ".cpp"), file = folder_ / (name + ".so");
  if (is_whole(file)) return;
  keep(source.filename(), request.text);
  try {
    const Passing library(own(file));
    const Compiler::Outcome outcome =
        compiler.compile(request.options, request.is_report_wanted, source, library.path());
    *said = outcome.messages;
    if (!is_there(library.path()) || !outcome.is_done) {
      throw NotCompiled("the compiler refuses it:\n" + outcome.messages);
    }
    if (request.is_report_wanted) keep(with(file, ".txt").filename(), outcome.messages);
    library.become(file);
  } catch (const NotCompiled &) {
    ::unlink(source.c_str());
    throw;
  }
  trim();
}

/// Entries beyond the largest size go, those that were not used for longest first.
void Cache::trim() const {
  struct Entry {
    fs::path library;
    fs::file_time_type used;
    std::uintmax_t size;
  };
  std::vector<Entry> entries;
  std::uintmax_t total = 0;
  std::error_code gone;  // another process may be at the same work
  for (const auto &found : fs::directory_iterator(folder_, gone)) {
    if (found.path().extension() != ".so" && found.path().extension() != ".bin") continue;
    const auto size_of = [&](const fs::path &file) {
      const std::uintmax_t size = fs::file_size(file, gone);
      return gone ? 0 : size;
    };
    entries.push_back(
        {found.path(), found.last_write_time(gone), size_of(found.path()) + size_of(with(found.path(), ".cpp"))});
    total += entries.back().size;
  }
  std::sort(entries.begin(), entries.end(), [](const Entry &a, const Entry &b) { return a.used < b.used; });
  for (std::size_t i = 0; i + 1 < entries.size() && total > largest_; i++) {  // the newest is about to be loaded
    for (const char *extension : {".so", ".bin", ".cpp", ".txt"}) fs::remove(with(entries[i].library, extension), gone);
    total -= entries[i].size;
  }
}

}  // namespace hg::jit
