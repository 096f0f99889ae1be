#include "reports/links.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "verification/verdict_file.hpp"

namespace voussoir::reports {
namespace {

namespace fs = std::filesystem;

// as the content of a data address
std::string base64(const std::string& bytes) {
  constexpr const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : letters[word >> (18 - 6 * k) & 63];
  }
  return text;
}

}  // namespace

std::optional<std::string> place_of(const Anchors& anchors, const fs::path& text, const std::string& target) {
  if (target.starts_with("http") || target.starts_with("#")) return target;
  const std::size_t hash = target.find('#');
  const std::string file = target.substr(0, hash);
  const fs::path path = (text.parent_path() / file).lexically_normal();
  if (const auto found = anchors.find(path.string()); found != anchors.end())
    return "#" + found->second + (hash == std::string::npos ? "" : "--" + slug(target.substr(hash + 1)));
  if (path.parent_path().parent_path() != "cases") return std::nullopt;
  const std::string of_case = "#" + slug(path.parent_path().filename().string());
  if (path.filename() == "README.md") return of_case;
  if (path.filename() == "NOTES.md") return of_case + "-notes";
  if (path.extension() == ".toml") return fmt::format("{}-{}", of_case, slug(path.filename().string()));
  return std::nullopt;
}

std::string picture_of(const Folders& folders, const fs::path& text, const std::string& target,
                       const std::string& caption, const std::string& prefix, const std::vector<fs::path>& drawn) {
  const fs::path beside = folders.source / text.parent_path() / target;
  if (beside.extension() == ".png" && fs::exists(beside))
    return figure(
        fmt::format("<img alt=\"\" src=\"data:image/png;base64,{}\">", base64(verification::read_text(beside))),
        caption);
  std::vector<fs::path> places{folders.build / "reports" / "figures"};
  places.insert(places.end(), drawn.begin(), drawn.end());
  places.push_back(beside.parent_path());
  const std::string stem = fs::path(target).stem().string();
  return drawn_figure(places, stem, slug(prefix + "-" + stem), caption);
}

LinkRules rules_of(const Folders& folders, const fs::path& text, const std::string& who,
                   std::vector<std::string>& missing) {
  return {[&folders, text](const std::string& target) { return place_of(folders.anchors, text, target); },
          [&folders, &missing, text, who](const std::string& target,
                                          const std::string& caption) -> std::optional<std::string> {
            try {
              return picture_of(folders, text, target, caption, who);
            } catch (const std::runtime_error& problem) {
              missing.push_back(fmt::format("{}: {}", who, problem.what()));
              return fmt::format("<p class=\"note\">{}</p>\n", escape(problem.what()));
            }
          }};
}

}  // namespace voussoir::reports
