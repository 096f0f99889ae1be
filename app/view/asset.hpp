// The parts of a page around its data: viewer/bundle, made from viewer/src (viewer/README.md).
#pragma once

#include <string_view>

namespace voussoir::viewer {

extern const std::string_view script;                   // once a page: style and script
extern const std::string_view before_page, after_page;  // around script and fragment
// a fragment: the initial view, a poster with its type or none, the data, each in base64
extern const std::string_view before_look, before_poster, before_data, after_fragment;

}  // namespace voussoir::viewer
