#include "app/view/view_command.hpp"

#include <fmt/format.h>

#include <limits>

#include "app/base/arguments.hpp"
#include "app/run_folder/claimed_folder.hpp"
#include "app/run_folder/run_folder.hpp"
#include "app/view/page.hpp"
#include "core/base/bad_input.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/view.hpp"
#include "text/read_file.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

struct ViewArguments {
  std::filesystem::path folder;
  std::filesystem::path out;     // empty: view.html in the folder
  bool fragment = false;         // for a page that contains the viewer once and many of these
  bool script = false;           // the part that such a page contains once; then no folder is read
  std::filesystem::path poster;  // a picture, PNG or WebP, shown until it is clicked; empty: none
  std::string look;              // initial view of a fragment, as after # in a page's address
  bool overwrite = false;
};

fs::path target_of(const ViewArguments& arguments) {
  return arguments.out.empty() ? arguments.folder / page_file : arguments.out;
}

void refuse_target(const fs::path& file, const ViewArguments& arguments, const std::vector<fs::path>& inputs) {
  std::error_code error;
  for (const fs::path& input : inputs)
    if (fs::equivalent(file, input, error))
      throw BadInput(fmt::format("'{}' is read and would be replaced: choose another file with --out", file.string()));
  const fs::file_status there = fs::symlink_status(file, error);
  if (there.type() == fs::file_type::directory)
    throw BadInput(fmt::format("'{}' is a folder: name a file with --out", file.string()));
  const bool ours = arguments.out.empty() && made_here(arguments.folder, page_file);
  if (there.type() != fs::file_type::not_found && !arguments.overwrite && !ours)
    throw BadInput(
        fmt::format("'{}' exists and would be replaced: choose another with --out, or add --overwrite", file.string()));
}

// the file that the run kept, or the reason if there is none
fs::path data_of(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw BadInput(fmt::format("'{}' is not a folder: name the folder of a run", folder.string()));
  const fs::path data = folder / view_file;
  if (fs::exists(data, error)) return data;
  if (holds_results(folder) || holds_unfinished_run(folder))
    throw BadInput(
        fmt::format("'{}' has no {}: its run was made without --view; run the scene again with 'voussoir run … --view'",
                    folder.string(), view_file));
  throw BadInput(fmt::format("'{}' contains no run: make one with 'voussoir run … --view'", folder.string()));
}

std::string poster_of(const ViewArguments& arguments) {
  constexpr std::uintmax_t most = 16U << 20;
  if (arguments.poster.empty()) return {};
  try {
    std::string picture = read_file(arguments.poster, most);
    if (picture_type(picture).empty())
      throw BadInput(
          fmt::format("'{}' is neither PNG nor WebP: viewer/poster.mjs makes one", arguments.poster.string()));
    return picture;
  } catch (const ReadFault& fault) {
    throw BadInput(fmt::format("'{}': {}", arguments.poster.string(), fault.what()));
  }
}

ExitCode write_script(const ViewArguments& arguments) {
  if (!arguments.folder.empty()) throw BadInput("--script is the same for every run: leave the folder out");
  if (arguments.out.empty()) throw BadInput("--script needs --out, the file to write");
  refuse_target(arguments.out, arguments, {});
  write_file(arguments.out, viewer_script());
  return ExitCode::done;
}

ExitCode view_command(const ViewArguments& arguments) {
  if (arguments.script) return write_script(arguments);
  if (arguments.folder.empty()) throw BadInput("name the folder of a run made with --view");
  if (arguments.fragment && arguments.out.empty()) throw BadInput("--fragment needs --out, the file to write");
  const fs::path data = data_of(arguments.folder), target = target_of(arguments);
  std::vector<fs::path> inputs{data};
  if (!arguments.poster.empty()) inputs.push_back(arguments.poster);
  refuse_target(target, arguments, inputs);
  write_file(target, arguments.fragment ? view_fragment(data, poster_of(arguments), arguments.look) : view_page(data));
  fmt::print("{}\n", target.string());
  return ExitCode::done;
}

}  // namespace

void add_view(CLI::App& program, Action& action) {
  const auto [command, arguments] = add_command(
      program, action, "view", "write the interactive 3-D page view.html (for a run made with --view)", view_command);
  command->add_option("folder", arguments.folder, "folder of the run's results")->check(plain_text());
  add_out(command, arguments.out, "the page (default: view.html in the folder)");
  CLI::Option* fragment = command->add_flag(
      "--fragment", arguments.fragment,
      "write a fragment instead of a page, for a page with several fragments and the script of --script");
  command
      ->add_flag("--script", arguments.script,
                 "write the script that a page with fragments contains once; takes no folder")
      ->excludes(fragment);
  command
      ->add_option("--poster", arguments.poster,
                   "PNG or WebP that a fragment shows until it is clicked (viewer/poster.mjs makes it)")
      ->needs(fragment)
      ->check(plain_text());
  command
      ->add_option("--look", arguments.look,
                   "initial view of a fragment, as after # in a page's address: frame=3&magnified=100&forces=arrows")
      ->needs(fragment);
  command->add_flag("--overwrite", arguments.overwrite, "replace the file");
}

}  // namespace voussoir
