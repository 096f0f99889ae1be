#include "app/run_folder/claimed_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "core/base/bad_input.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/paraview.hpp"
#include "text/plain_text.hpp"
#include "text/read_file.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

constexpr const char* lock_file = ".lock";
constexpr const char* made_file = ".voussoir-made";
constexpr const char* lock_begins = "process ";
constexpr std::uintmax_t largest_list = 16 << 20;  // bytes
constexpr int most_tries = 20;                     // at a lock that is held, a millisecond apart

std::string host() {
  char name[256] = {};
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "unknown host";
}

// also a dangling link
bool entry_exists(const fs::path& path) {
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

bool holds(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

// ---- the lock

BadInput no_lock(const fs::path& path) {
  return BadInput(
      fmt::format("'{}' is no lock of this program: move it away, or choose another folder with --out", path.string()));
}

int open_lock(const fs::path& path) {
  // a link would let us write to another file, a pipe would block
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  if (file < 0 && (errno == ELOOP || errno == EISDIR || errno == ENXIO)) throw no_lock(path);
  if (file < 0) throw output_error(path, errno);
  struct stat status = {};
  if (::fstat(file, &status) != 0 || !S_ISREG(status.st_mode) || status.st_nlink != 1) {
    ::close(file);
    throw no_lock(path);
  }
  return file;
}

std::string holder_of(int file) {
  char text[300] = {};
  const ssize_t length = ::pread(file, text, sizeof text, 0);
  return length > 0 ? one_line({text, static_cast<std::size_t>(length)}, 200) : "";
}

// ---- files of an older command

// a plain name, or one below folders; no list may lead out of its own folder
bool is_safe(const std::string& name) {
  const fs::path path = name;
  return !name.empty() && path.is_relative() &&
         std::none_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".." || part == "."; });
}

// nothing if there is no list, or one that cannot be read: then no file there is ours
std::optional<Outputs> made_in(const fs::path& folder) {
  if (!entry_exists(folder / made_file)) return std::nullopt;
  try {
    const nlohmann::json list = nlohmann::json::parse(read_file(folder / made_file, largest_list));
    if (list.at("schema") != "voussoir.made" || list.at("schema_version") != 1) return std::nullopt;
    Outputs made{list.at("command"), list.at("files"), list.at("frames"), list.at("folders")};
    if (made.files.empty() || !std::all_of(made.files.begin(), made.files.end(), is_safe) ||
        !std::all_of(made.folders.begin(), made.folders.end(), is_safe))
      return std::nullopt;
    return made;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  } catch (const ReadFault&) {
    return std::nullopt;
  }
}

void write_made(const fs::path& folder, const Outputs& outputs) {
  const nlohmann::ordered_json list = {{"schema", "voussoir.made"},  {"schema_version", 1},
                                       {"command", outputs.command}, {"files", outputs.files},
                                       {"frames", outputs.frames},   {"folders", outputs.folders}};
  write_file(folder / made_file, list.dump(2) + "\n");
}

// the existing files with the names of these outputs, relative to the folder
std::vector<fs::path> standing(const fs::path& folder, const Outputs& outputs) {
  std::vector<fs::path> files;
  for (const std::string& name : outputs.files)
    if (entry_exists(folder / name)) files.emplace_back(name);
  if (!outputs.frames) return files;
  const std::vector<fs::path> series = series_files(folder);
  files.insert(files.end(), series.begin(), series.end());
  return files;
}

bool is_input(const fs::path& file, const std::vector<fs::path>& inputs) {
  return std::any_of(inputs.begin(), inputs.end(), [&](const fs::path& input) {
    std::error_code error;
    return fs::equivalent(file, input, error);
  });
}

bool is_made(const std::optional<Outputs>& made, const fs::path& name) {
  const bool of_series = name.parent_path() == "frames" || name.extension() == ".pvd";
  return made && (holds(made->files, name.string()) || (made->frames && of_series));
}

// ---- the rule

BadInput folder_is_taken(const fs::path& folder) {
  return BadInput(
      fmt::format("'{}' contains results: choose another folder with --out, or add --overwrite", folder.string()));
}

// whether results of an older command are complete, or can still be completed
void refuse_results(const fs::path& folder, const Outputs& outputs, const std::optional<Outputs>& made) {
  const auto has = [&](const char* name) {
    return entry_exists(folder / name) && (holds(outputs.files, name) || is_made(made, name));
  };
  if (has("results.json") || (made && entry_exists(folder / made->files.front()))) throw folder_is_taken(folder);
  if (has("run.json"))
    throw BadInput(
        fmt::format("'{0}' contains an interrupted run: continue with 'voussoir resume {0}', or add "
                    "--overwrite to start again",
                    folder.string()));
}

void require_free(const fs::path& folder, const Outputs& outputs, const std::vector<fs::path>& inputs, bool overwrite) {
  refuse_inputs(folder, outputs, inputs);
  const std::optional<Outputs> made = made_in(folder);
  if (made && made->command == "study" && outputs.command != "study")
    throw BadInput(fmt::format("'{}' contains a study: choose another folder with --out", folder.string()));
  const bool goes_on = made && outputs.goes_on && made->command == outputs.command;
  if (!overwrite && !goes_on) refuse_results(folder, outputs, made);
  for (const fs::path& name : standing(folder, outputs)) {
    const std::string path = (folder / name).string();
    if (fs::is_directory(fs::symlink_status(path)))
      throw BadInput(fmt::format(
          "'{}' is a folder where a file must be written: move it away, or choose another folder with --out", path));
    if (!overwrite && !is_made(made, name))
      throw BadInput(
          fmt::format("'{}' was not made by this program and would be replaced: choose another folder with --out, "
                      "move it away, or add --overwrite",
                      path));
  }
}

void remove_files(const fs::path& folder, const Outputs& outputs, const std::vector<fs::path>& inputs) {
  for (const fs::path& name : standing(folder, outputs))
    if (!is_input(folder / name, inputs)) remove_file(folder / name);
  if (outputs.frames) ::rmdir((folder / "frames").c_str());  // if it is empty
}

// a run of a study; files of others stay, and with them the folder
void remove_run(const fs::path& folder, const std::vector<fs::path>& inputs) {
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(folder, error))) return;
  const FolderLock lock(folder);
  if (const std::optional<Outputs> made = made_in(folder)) remove_files(folder, *made, inputs);
  for (const char* name : {messages_file, worker_file, failure_file, hash_file, made_file, lock_file})
    if (!is_input(folder / name, inputs)) remove_file(folder / name);
  ::rmdir(folder.c_str());
}

void remove_older(const fs::path& folder, const Outputs& outputs, const std::vector<fs::path>& inputs) {
  const std::optional<Outputs> made = made_in(folder);
  if (made)
    for (const std::string& name : made->folders)
      if (!holds(outputs.folders, name)) remove_run(folder / name, inputs);
  if (made && outputs.goes_on && made->command == outputs.command) {
    Outputs forgotten{made->command, made->files};
    std::erase_if(forgotten.files, [&](const std::string& name) { return holds(outputs.files, name); });
    return remove_files(folder, forgotten, inputs);
  }
  if (made) remove_files(folder, *made, inputs);
  remove_files(folder, outputs, inputs);
}

// before the lock is made: a refused folder is left unchanged
const fs::path& checked(const fs::path& folder, const Outputs& outputs, const std::vector<fs::path>& inputs,
                        bool overwrite) {
  if (!entry_exists(folder / lock_file)) require_free(folder, outputs, inputs, overwrite);
  return folder;
}

}  // namespace

std::optional<FileLock> FileLock::taken(const fs::path& path, bool shared, std::string& holder) {
  FileLock lock(open_lock(path));
  // a process that only checks the lock (holder_of_lock) has it for a moment
  for (int k = 0; ::flock(lock.file_, (shared ? LOCK_SH : LOCK_EX) | LOCK_NB) != 0; ++k) {
    if (errno != EWOULDBLOCK) throw output_error(path, errno);
    if (k == most_tries) {
      holder = holder_of(lock.file_);
      if (holder.empty()) holder = "another process";
      return std::nullopt;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (const std::string before = holder_of(lock.file_); !before.empty() && !before.starts_with(lock_begins))
    throw no_lock(path);
  // information for people; the lock itself is the kernel's
  const std::string name = fmt::format("{}{} on {}", lock_begins, ::getpid(), host());
  if (::ftruncate(lock.file_, 0) != 0 || ::pwrite(lock.file_, name.data(), name.size(), 0) < 0)
    throw output_error(path, errno);
  return lock;
}

FileLock::~FileLock() {
  if (file_ >= 0) ::close(file_);
}

std::optional<std::string> holder_of_lock(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (file < 0) return std::nullopt;
  std::optional<std::string> holder;
  if (::flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK) holder = holder_of(file);
  ::close(file);
  return holder;
}

namespace {

FileLock locked(const fs::path& folder, bool shared) {
  prepare_folder(folder);
  std::string holder;
  std::optional<FileLock> lock = FileLock::taken(folder / lock_file, shared, holder);
  if (!lock)
    throw FolderInUse(
        fmt::format("'{}' is in use by {}: wait for it, or choose another folder with --out", folder.string(), holder));
  return std::move(*lock);
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder) : lock_(locked(folder, false)) {
  // no other process writes here now
  remove_unfinished_files(folder);
  remove_unfinished_files(folder / "frames");
}

SharedFolderLock::SharedFolderLock(const fs::path& folder) : lock_(locked(folder, true)) {}

ReadingLock::ReadingLock(const fs::path& folder)
    : file_(::open((folder / lock_file).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK)) {
  if (file_ < 0 || ::flock(file_, LOCK_SH | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  const std::string holder = holder_of(file_);
  ::close(file_);
  throw FolderInUse(fmt::format("'{}' is being written by {}: wait for it before you begin at its end", folder.string(),
                                holder.empty() ? "another process" : holder));
}

ReadingLock::~ReadingLock() {
  if (file_ >= 0) ::close(file_);
}

bool made_here(const fs::path& folder, const std::string& name) {
  return is_made(made_in(folder), name);
}

void refuse_inputs(const fs::path& folder, const Outputs& outputs, const std::vector<fs::path>& inputs) {
  for (const fs::path& name : standing(folder, outputs))
    if (is_input(folder / name, inputs))
      throw BadInput(
          fmt::format("'{}' is read by this command, which would write over it: choose another folder with "
                      "--out",
                      (folder / name).string()));
}

ClaimedFolder::ClaimedFolder(const fs::path& folder, const Outputs& outputs, const std::vector<fs::path>& inputs,
                             bool overwrite)
    : lock_(checked(folder, outputs, inputs, overwrite)) {
  require_free(folder, outputs, inputs, overwrite);
  remove_older(folder, outputs, inputs);
  write_made(folder, outputs);
}

void claim_file(const fs::path& file, const std::string& command, const std::vector<fs::path>& inputs, bool overwrite) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  refuse_inputs(folder, {command, {file.filename().string()}}, inputs);
  std::error_code error;
  const fs::file_status status = fs::symlink_status(file, error);
  if (fs::is_directory(status)) throw BadInput(fmt::format("'{}' is a folder; name a file with --out", file.string()));
  if (fs::exists(status) && !overwrite)
    throw BadInput(fmt::format("'{}' exists and would be replaced: choose another name with --out, or add --overwrite",
                               file.string()));
  prepare_folder(folder);
}

}  // namespace voussoir
