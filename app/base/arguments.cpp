#include "app/base/arguments.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <system_error>

#include "core/base/bad_input.hpp"
#include "text/plain_text.hpp"

namespace voussoir {

CLI::Validator finite(double low, double high) {
  const CLI::Range range(low, high);
  return {[range](std::string& text) {
            double number = 0;
            const char* const end = text.data() + text.size();
            const auto [stop, error] = std::from_chars(text.data(), end, number);
            const bool is_number = error == std::errc() && stop == end && std::isfinite(number);
            return is_number ? range(text) : "must be a finite decimal number, not '" + text + "'";
          },
          range.get_description()};
}

CLI::Validator plain_text() {
  return {[](std::string& text) -> std::string {
            if (text.empty()) return "must not be empty";
            const auto fault = text_fault(text);
            return fault ? "must not contain " + fault->what : "";
          },
          ""};
}

// numbers separated by a slash
std::vector<double> slashed(const std::string& text, const char* option, const char* form) {
  std::vector<double> numbers;
  const char *place = text.data(), *end = place + text.size();
  while (true) {
    double number = 0;
    const auto [next, error] = std::from_chars(place, end, number);
    if (error != std::errc() || !std::isfinite(number) || (next != end && *next != '/'))
      throw BadInput(fmt::format("{} {}: write {}", option, text, form));
    numbers.push_back(number);
    if (next == end) return numbers;
    place = next + 1;
  }
}

void add_scene(CLI::App* command, SceneArguments& arguments) {
  command->add_option("scene", arguments.scene, "scene file (TOML)")
      ->required()
      ->check(plain_text())
      ->type_name("FILE");
  add_repeated(command, "--set", arguments.overrides,
               "replace a value of the scene; tables of a list are addressed by name, e.g. joints.A.dip=65; repeat "
               "--set for each value")
      ->type_name("KEY=VALUE")
      ->check(plain_text());
}

void add_out(CLI::App* command, std::filesystem::path& out, const std::string& meaning, bool required) {
  command->add_option("--out", out, meaning)->check(plain_text())->required(required)->type_name("FOLDER");
}

void add_overwrite(CLI::App* command, bool& overwrite) {
  command->add_flag("--overwrite", overwrite,
                    "remove the results in the folder, and replace files of the names that are written; files that "
                    "this command reads are never replaced");
}

void add_threads(CLI::App* command, int& threads) {
  command->add_option("--threads", threads, "number of threads; the results do not depend on it")
      ->check(CLI::Range(1, 1024));
}

}  // namespace voussoir
