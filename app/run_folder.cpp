#include "app/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/output/atomic_file.hpp"
#include "core/output/paraview.hpp"
#include "core/simulate.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

constexpr int conduct_version = 1;
constexpr int most_threads = 1024;  // as on the command line
const char* const newest = "checkpoint";
const char* const previous = "checkpoint.previous";

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

// whole or refused: streams would end quietly where reading fails
std::string content_of(const fs::path& path) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  std::string content(error ? 0 : size, '\0');
  std::ifstream file(path, std::ios::binary);
  if (error || !file.read(content.data(), static_cast<std::streamsize>(size)))
    throw BadInput(fmt::format("cannot read '{}'", path.string()));
  return content;
}

std::string host() {
  char name[256] = {};
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "unknown host";
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder) {
  prepare_folder(folder);
  const fs::path path = folder / ".lock";
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) throw output_error(path, errno);
  if (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
    const int error = errno;
    ::close(file_);
    if (error != EWOULDBLOCK) throw output_error(path, error);
    const std::string holder = content_of(path);
    throw FolderInUse(fmt::format("'{}' is in use by {}: wait for it, or choose another folder with --out",
                                  folder.string(), holder.empty() ? "another process" : holder));
  }
  // for whom it may concern; the lock itself is the kernel's
  const std::string holder = fmt::format("process {} on {}", ::getpid(), host());
  if (::ftruncate(file_, 0) != 0 || ::pwrite(file_, holder.data(), holder.size(), 0) < 0) {
    const int error = errno;
    ::close(file_);
    throw output_error(path, error);
  }

  // nobody else writes here now
  remove_unfinished_files(folder);
  remove_unfinished_files(folder / "frames");
}

FolderLock::~FolderLock() {
  ::close(file_);
}

void write_conduct(const fs::path& folder, const RunConduct& conduct) {
  const nlohmann::ordered_json json = {{"schema", "voussoir.run"},
                                       {"schema_version", conduct_version},
                                       {"program", build_name()},
                                       {"scene_hash", conduct.scene_hash},
                                       {"threads", conduct.threads},
                                       {"checkpoint_steps", conduct.checkpoint_steps},
                                       {"checkpoint_seconds", conduct.checkpoint_seconds},
                                       {"warnings", conduct.warnings}};
  write_file(folder / "run.json", json.dump(2) + "\n");
}

RunConduct read_conduct(const fs::path& folder) {
  const fs::path path = folder / "run.json";
  try {
    const nlohmann::json json = nlohmann::json::parse(content_of(path));
    if (json.at("schema") != "voussoir.run" || json.at("schema_version") != conduct_version)
      throw BadInput(fmt::format("'{}' was written by another version of this program", path.string()));
    const RunConduct conduct{json.at("scene_hash"), json.at("threads"), json.at("checkpoint_steps"),
                             json.at("checkpoint_seconds"), json.at("warnings")};
    if (conduct.threads < 1 || conduct.threads > most_threads || conduct.checkpoint_steps < 0 ||
        !(conduct.checkpoint_seconds >= 0))
      throw BadInput(
          fmt::format("'{}' is damaged (a number is out of range): start again with 'voussoir run "
                      "--overwrite'",
                      path.string()));
    return conduct;
  } catch (const nlohmann::json::exception& error) {
    throw BadInput(
        fmt::format("'{}' is damaged ({}): start again with 'voussoir run --overwrite'", path.string(), error.what()));
  }
}

BadInput folder_is_taken(const fs::path& folder) {
  return BadInput(
      fmt::format("'{}' holds results: choose another folder with --out, or add --overwrite", folder.string()));
}

bool holds_results(const fs::path& folder) {
  return is_there(folder / "results.json");
}

bool holds_unfinished_run(const fs::path& folder) {
  return is_there(folder / "run.json") && !holds_results(folder);
}

bool holds_checkpoints(const fs::path& folder) {
  return is_there(folder / newest) || is_there(folder / previous);
}

void remove_old_run(const fs::path& folder) {
  remove_file(folder / "results.json");
  remove_checkpoints(folder);
  for (const char* name : {"run.json", "history.csv", "scene.toml"})
    remove_file(folder / name);
  cut_back(folder, {});
}

void remove_checkpoints(const fs::path& folder) {
  remove_file(folder / newest);
  remove_file(folder / previous);
}

template <int Dim>
void save_checkpoint(const fs::path& folder, const Progress<Dim>& progress, const std::string& scene_hash) {
  write_file_and_keep(folder / newest, folder / previous, checkpoint_bytes(progress, scene_hash));
}

template <int Dim>
Progress<Dim> last_progress(const fs::path& folder, const Prepared<Dim>& scene, const std::string& scene_hash,
                            std::vector<std::string>& remarks) {
  std::vector<std::string> refusals;
  for (const char* name : {newest, previous}) {
    const fs::path path = folder / name;
    if (!is_there(path)) continue;
    try {
      const std::string bytes = content_of(path);
      Progress<Dim> progress = read_checkpoint<Dim>(bytes, scene_hash);
      if (const std::string build = checkpoint_record(bytes).build; build != build_name())
        remarks.push_back(fmt::format("'{}' was written by {}, this is {}: the last bits may differ", path.string(),
                                      build, build_name()));
      // what cannot be used must not displace what can when the next checkpoint is written
      if (!refusals.empty()) {
        move_file(path, folder / newest);
        remarks.push_back(fmt::format("{}; the one before it is used", refusals.front()));
      }
      return progress;
    } catch (const CheckpointError& error) {
      refusals.push_back(fmt::format("'{}' {}", path.string(), error.what()));
    } catch (const BadInput& error) {
      refusals.push_back(error.what());
    }
  }
  if (!refusals.empty())
    throw BadInput(
        fmt::format("no checkpoint can be used: {}; put back what was changed, or start again with 'voussoir "
                    "run --overwrite'",
                    fmt::join(refusals, "; ")));
  return begin(scene);
}

template void save_checkpoint<2>(const fs::path&, const Progress<2>&, const std::string&);
template void save_checkpoint<3>(const fs::path&, const Progress<3>&, const std::string&);
template Progress<2> last_progress<2>(const fs::path&, const Prepared<2>&, const std::string&,
                                      std::vector<std::string>&);
template Progress<3> last_progress<3>(const fs::path&, const Prepared<3>&, const std::string&,
                                      std::vector<std::string>&);

}  // namespace voussoir
