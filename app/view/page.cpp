#include "app/view/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "app/base/gzip.hpp"
#include "app/view/asset.hpp"
#include "core/base/bad_input.hpp"
#include "core/output/view.hpp"
#include "text/read_file.hpp"

namespace voussoir {
namespace {

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= n ? digits[group >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

std::string view_bytes(const std::filesystem::path& file) {
  std::string bytes;
  try {
    bytes = read_file(file, std::numeric_limits<std::uintmax_t>::max());
  } catch (const ReadFault& fault) {
    throw BadInput(fmt::format("'{}': {}", file.string(), fault.what()));
  }
  const ViewExtent whole = view_extent(bytes, std::numeric_limits<int>::max());
  if (whole.frames == 0)
    throw BadInput(
        fmt::format("'{}' is no file of a run for the viewer, or is damaged or of an earlier version: run the scene "
                    "again with 'voussoir run … --view'",
                    file.string()));
  bytes.resize(whole.bytes);
  return bytes;
}

}  // namespace

std::string viewer_script() {
  return std::string(viewer::viewer_script) + std::string(viewer::loading);
}

std::string_view picture_type(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return "png";
  return bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP") ? "webp" : "";
}

std::string view_fragment(const std::filesystem::path& data, std::string_view poster, std::string_view look) {
  std::string html(viewer::before_look);
  html += base64(look);
  if (!poster.empty())
    html += fmt::format("{}{};base64,{}", viewer::before_poster, picture_type(poster), base64(poster));
  html += viewer::before_data;
  html += base64(gzipped(view_bytes(data)));
  return html += viewer::after_fragment;
}

std::string view_page(const std::filesystem::path& data) {
  std::string html(viewer::before_page);
  html += viewer_script();
  html += view_fragment(data);
  return html += viewer::after_page;
}

std::string report_page(const std::string& json, const std::filesystem::path& blocks) {
  std::string html(viewer::before_report);
  html += base64(gzipped(json));
  html += viewer::after_report_data;
  if (!blocks.empty()) {
    html += viewer::before_blocks;
    html += view_fragment(blocks);
    html += viewer::after_blocks;
    html += viewer::viewer_script;
  }
  html += viewer::report_script;
  html += viewer::loading;
  return html += viewer::after_page;
}

}  // namespace voussoir
