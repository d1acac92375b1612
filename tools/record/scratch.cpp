#include "tools/record/scratch.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

namespace fs = std::filesystem;

constexpr int kMostTries = 100;
constexpr std::size_t kLongestName = 255;  // [B] in every file system that matters
constexpr std::size_t kLetters = 8;
constexpr std::string_view kFolderBefore = ".ghtrack-";
constexpr std::string_view kAfter = ".partial";

/// The paths that are to go if the process has to end at once. Fixed in size and without locks,
/// because a signal handler reads it; what finds no room is removed by its destructor only.
std::array<std::atomic<char*>, 256> standing{};

int register_path(const fs::path& path) {
  char* const copy = ::strdup(path.c_str());
  for (std::size_t i = 0; copy != nullptr && i < standing.size(); ++i) {
    char* expected = nullptr;
    if (standing[i].compare_exchange_strong(expected, copy)) return static_cast<int>(i);
  }
  std::free(copy);
  return -1;
}

void unregister(int slot) {
  if (slot >= 0) std::free(standing.at(static_cast<std::size_t>(slot)).exchange(nullptr));
}

std::string random_letters() {
  constexpr std::string_view kAlphabet = "abcdefghijklmnopqrstuvwxyz234567";
  std::array<unsigned char, kLetters> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    static std::atomic<unsigned> calls = 0;  // unique in this machine at least
    const unsigned mixed = static_cast<unsigned>(::getpid()) * 2654435761U + calls++;
    std::memcpy(bytes.data(), &mixed, sizeof mixed);
  }
  std::string letters;
  for (const unsigned char byte : bytes) letters += kAlphabet[byte % kAlphabet.size()];
  return letters;
}

/// Makes something under a name that is not there yet.
template <class Name, class Make>
fs::path make_new(const fs::path& target, const Name& name, const Make& make) {
  for (int i = 0; i < kMostTries; ++i) {
    const fs::path path = name(random_letters());
    if (make(path)) return path;
    if (errno != EEXIST) throw WriteError(target, errno);
  }
  throw WriteError(target, EEXIST);
}

/// Removes what is in an open folder, and deeper. No library call in it allocates memory.
void empty_folder(int folder) noexcept {
  struct Entry {  // what the system call writes, see getdents64(2)
    std::uint64_t inode;
    std::int64_t offset;
    unsigned short length;
    unsigned char type;
    char name[1];
  };
  alignas(Entry) char buffer[4096];
  for (;;) {
    const long got = ::syscall(SYS_getdents64, folder, buffer, sizeof buffer);
    if (got <= 0) return;
    for (long at = 0; at < got;) {
      const Entry& entry = *reinterpret_cast<const Entry*>(buffer + at);
      at += entry.length;
      const char* const name = entry.name;
      if (std::strcmp(name, ".") == 0 || std::strcmp(name, "..") == 0) continue;
      if (::unlinkat(folder, name, 0) == 0) continue;
      const int inner = ::openat(folder, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
      if (inner < 0) continue;
      empty_folder(inner);
      ::close(inner);
      ::unlinkat(folder, name, AT_REMOVEDIR);
    }
  }
}

/// Removes a file, or a folder with what is in it; links are not followed.
void remove_path(const char* path) noexcept {
  if (::unlink(path) == 0) return;
  const int folder = ::open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (folder < 0) return;
  empty_folder(folder);
  ::close(folder);
  ::rmdir(path);
}

}  // namespace

Scratch::Scratch(fs::path path) : path_(std::move(path)), slot_(register_path(path_)) {}

Scratch::Scratch(Scratch&& other) noexcept
    : path_(std::exchange(other.path_, {})), slot_(std::exchange(other.slot_, -1)) {}

Scratch::~Scratch() {
  if (path_.empty()) return;
  remove_path(path_.c_str());
  unregister(slot_);
}

void Scratch::release() {
  unregister(std::exchange(slot_, -1));
  path_.clear();
}

Scratch Scratch::file_beside(const fs::path& target, int& descriptor) {
  const std::string name =
      target.filename().string().substr(0, kLongestName - kAfter.size() - kLetters - 1);
  const auto named = [&](const std::string& letters) {
    return target.parent_path() / (name + "." + letters + std::string(kAfter));
  };
  return Scratch(make_new(target, named, [&](const fs::path& path) {
    constexpr int kFlags = O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
    descriptor = ::open(path.c_str(), kFlags, 0666);
    return descriptor >= 0;
  }));
}

Scratch Scratch::folder_in(const fs::path& folder) {
  const auto named = [&](const std::string& letters) {
    return folder / (std::string(kFolderBefore) + letters + std::string(kAfter));
  };
  return Scratch(make_new(folder, named,
                          [](const fs::path& path) { return ::mkdir(path.c_str(), 0777) == 0; }));
}

bool Scratch::is_folder_name(const fs::path& name) {
  const std::string text = name.string();
  return text.size() == kFolderBefore.size() + kLetters + kAfter.size() &&
         text.starts_with(kFolderBefore) && text.ends_with(kAfter);
}

void remove_all_scratch() noexcept {
  for (std::atomic<char*>& slot : standing) {
    if (const char* const path = slot.load()) remove_path(path);
  }
}

}  // namespace ghtrack
