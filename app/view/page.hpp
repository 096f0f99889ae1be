// An interactive 3-D page of a run's blocks in one HTML file: viewer/'s script and the file of core/output/view.hpp,
// each compressed and as base64, so that no text of a scene becomes part of the page.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace voussoir {

inline constexpr const char* page_file = "view.html";

// The complete page of a run's `view.bin`; a frame that was being written when a program was killed is left out. Throws
// BadInput if the file is no such file.
std::string view_page(const std::filesystem::path& data);

// png or webp; empty if it is neither
std::string_view picture_type(std::string_view bytes);

// The same for a page that contains viewer_script() once: a figure that shows the poster, the bytes of a picture, and
// starts when it is clicked. Without a poster it starts immediately if it is the page's only one. `look` is the part
// after # in a page's address.
std::string view_fragment(const std::filesystem::path& data, std::string_view poster = {}, std::string_view look = {});
std::string viewer_script();

// The report on a run: JSON of its texts (app/report/report_data.hpp), drawn by a script of viewer/; with a run's
// `view.bin` its blocks can be turned in it. Throws as view_page.
std::string report_page(const std::string& json, const std::filesystem::path& blocks = {});

}  // namespace voussoir
