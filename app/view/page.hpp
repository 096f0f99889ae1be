// One HTML file in which the blocks of a run can be turned: viewer/'s script and the file of core/output/view.hpp, each
// compressed and as base64, so that no text of a scene becomes part of the page.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace voussoir {

inline constexpr const char* page_file = "view.html";

// The whole page of a run's `view.bin`; frames that were being written when a program was killed are left out. Throws
// BadInput if the file is none.
std::string view_page(const std::filesystem::path& data);

// png or webp; empty for what is neither
std::string_view picture_type(std::string_view bytes);

// The same for a page that holds viewer_script() once: a figure that shows the poster, bytes of such a picture, and
// starts when it is clicked. Without a poster it starts at once where it is the page's only one. `look` is what would
// stand behind # in a page's address.
std::string view_fragment(const std::filesystem::path& data, std::string_view poster = {}, std::string_view look = {});
std::string viewer_script();

}  // namespace voussoir
