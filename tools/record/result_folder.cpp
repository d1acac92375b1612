#include "tools/record/result_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

namespace fs = std::filesystem;

bool is_folder(int at, const std::string& name) {
  struct stat about {};
  return ::fstatat(at, name.c_str(), &about, AT_SYMLINK_NOFOLLOW) == 0 && S_ISDIR(about.st_mode);
}

/// Moves files from one folder into another and can take that back: what a file replaces lies in
/// its former place until then.
class Exchange {
 public:
  Exchange(int from, int to) : from_(from), to_(to) {}

  /// @returns 0, or the error number
  int put(const std::string& name) {
    if (is_folder(to_, name)) return EISDIR;
    if (rename(from_, to_, name, RENAME_EXCHANGE)) {
      replaced_.push_back(name);
      return 0;
    }
    // Nothing to be replaced, or a file system that cannot exchange.
    if (errno != ENOENT && errno != EINVAL && errno != ENOSYS) return errno;
    if (!rename(from_, to_, name, 0)) return errno;
    added_.push_back(name);
    return 0;
  }

  void take_back() {
    for (const std::string& name : replaced_) rename(from_, to_, name, RENAME_EXCHANGE);
    for (const std::string& name : added_) rename(to_, from_, name, 0);
  }

 private:
  static bool rename(int from, int to, const std::string& name, unsigned flags) {
    return ::renameat2(from, name.c_str(), to, name.c_str(), flags) == 0;
  }

  int from_;
  int to_;
  std::vector<std::string> replaced_, added_;
};

}  // namespace

ResultFolder::ResultFolder(fs::path folder) : folder_(std::move(folder)) {
  make_folder(folder_);
  lock();
  try {
    scratch_.emplace(Scratch::folder_in(folder_));
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

ResultFolder::~ResultFolder() {
  scratch_.reset();
  ::close(descriptor_);
}

void ResultFolder::lock() {
  descriptor_ = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0) throw WriteError(folder_, errno);
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return remove_stale_scratch();
  // Some network file systems have no locks on folders: names of their own keep processes apart.
  if (errno != EWOULDBLOCK) return;
  ::close(descriptor_);
  throw WriteError(folder_.string() +
                   ": error: another process is writing its results into this folder; wait for "
                   "it, or choose another folder with -o");
}

/// Who holds the lock is alone, so what a killed process left here is nobody's.
void ResultFolder::remove_stale_scratch() const {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, ignored)) {
    const bool stale = Scratch::is_folder_name(entry.path().filename()) &&
                       !entry.is_symlink(ignored) && entry.is_directory(ignored);
    if (stale) fs::remove_all(entry.path(), ignored);
  }
}

std::vector<std::string> ResultFolder::made(bool partial_only) const {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(scratch())) {
    const std::string name = entry.path().filename().string();
    const bool is_partial = name.find(".partial") != std::string::npos;
    if (entry.is_regular_file() && is_partial == partial_only) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

void ResultFolder::put(const std::vector<std::string>& names) {
  const int from = ::open(scratch().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (from < 0) throw WriteError(folder_, errno);
  Exchange exchange(from, descriptor_);
  int error = 0;
  for (const std::string& name : names) {
    error = exchange.put(name);
    if (error == 0) continue;
    exchange.take_back();
    ::close(from);
    throw WriteError(folder_ / name, error);
  }
  ::fsync(descriptor_);
  ::close(from);
}

void ResultFolder::commit() { put(made(false)); }

void ResultFolder::keep_partial() { put(made(true)); }

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && fs::is_directory(folder, error)) return;
  const std::string reason = error ? error.message() : "a file of that name is in the way";
  throw WriteError(folder.string() + ": error: the folder cannot be made: " + reason);
}

}  // namespace ghtrack
