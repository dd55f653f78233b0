#include "library_file.hpp"

#include <elf.h>
#include <link.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "error.hpp"

namespace hg {

namespace {

#if defined(__x86_64__) && defined(__LP64__)
constexpr unsigned own_machine = EM_X86_64;
#elif defined(__aarch64__)
constexpr unsigned own_machine = EM_AARCH64;
#elif defined(__powerpc64__)
constexpr unsigned own_machine = EM_PPC64;
#elif defined(__riscv)
constexpr unsigned own_machine = EM_RISCV;
#else
constexpr unsigned own_machine = EM_NONE;  // not known: the dynamic loader decides
#endif
constexpr unsigned own_class = sizeof(void *) == 8 ? ELFCLASS64 : ELFCLASS32;
constexpr unsigned own_order = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? ELFDATA2LSB : ELFDATA2MSB;

std::string machine_name(unsigned machine) {
  switch (machine) {
    case EM_X86_64:
      return "x86-64";
    case EM_386:
      return "i386";
    case EM_AARCH64:
      return "AArch64";
    case EM_ARM:
      return "ARM";
    case EM_PPC64:
      return "PowerPC 64";
    case EM_RISCV:
      return "RISC-V";
    case EM_S390:
      return "S/390";
    default:
      return text("ELF machine %u", machine);
  }
}

/// Reads objects at offsets of a file.
class File {
 public:
  explicit File(const std::filesystem::path &path) : stream_(path, std::ios::binary) {
    stream_.seekg(0, std::ios::end);
    size_ = stream_ ? static_cast<std::uint64_t>(stream_.tellg()) : 0;
  }
  bool is_open() const { return stream_.is_open(); }
  std::uint64_t size() const { return size_; }
  template <typename T>
  bool read(std::uint64_t offset, T &object) {
    if (offset > size_ || sizeof(T) > size_ - offset) return false;
    stream_.seekg(static_cast<std::streamoff>(offset));
    return static_cast<bool>(stream_.read(reinterpret_cast<char *>(&object), sizeof object));
  }

 private:
  std::ifstream stream_;
  std::uint64_t size_ = 0;
};

std::string cut_short(const char *what, std::uint64_t wanted, std::uint64_t size) {
  return text("the file is cut short: %s to byte %llu, it has %llu", what, static_cast<unsigned long long>(wanted),
              static_cast<unsigned long long>(size));
}

}  // namespace

std::string why_not_loadable(const std::filesystem::path &path) {
  std::error_code failure;
  const auto status = std::filesystem::status(path, failure);
  if (!std::filesystem::exists(status)) return failure ? failure.message() : std::strerror(ENOENT);
  if (!std::filesystem::is_regular_file(status)) return "it is no regular file";
  errno = 0;
  File file(path);
  if (!file.is_open()) return std::strerror(errno != 0 ? errno : EACCES);

  unsigned char ident[EI_NIDENT];
  if (!file.read(0, ident) || std::memcmp(ident, ELFMAG, SELFMAG) != 0) {
    return "it is no shared library (no ELF header)";
  }
  if (ident[EI_CLASS] != own_class) {
    return text("wrong architecture: it is a %s-bit library, this process has %zu bits",
                ident[EI_CLASS] == ELFCLASS64 ? "64" : "32", 8 * sizeof(void *));
  }
  if (ident[EI_DATA] != own_order) return "wrong architecture: its byte order is not that of this machine";
  ElfW(Ehdr) header;
  if (!file.read(0, header)) return cut_short("the ELF header goes", sizeof header, file.size());
  if (own_machine != EM_NONE && header.e_machine != own_machine) {
    return text("wrong architecture: it is for %s, this process runs on %s", machine_name(header.e_machine).c_str(),
                machine_name(own_machine).c_str());
  }
  if (header.e_type != ET_DYN) return "it is an ELF file, but no shared library";

  for (unsigned i = 0; i < header.e_phnum; i++) {
    ElfW(Phdr) segment;
    const std::uint64_t place = header.e_phoff + static_cast<std::uint64_t>(i) * header.e_phentsize;
    if (!file.read(place, segment)) return cut_short("its segment table goes", place + sizeof segment, file.size());
    const std::uint64_t end = static_cast<std::uint64_t>(segment.p_offset) + segment.p_filesz;
    if (segment.p_type == PT_LOAD && (end > file.size() || end < segment.p_offset)) {
      return cut_short("a segment goes", end, file.size());
    }
  }
  return "";
}

}  // namespace hg
