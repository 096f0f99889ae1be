// The parts of a page around its data: viewer/bundle, made from viewer/src (viewer/README.md).
#pragma once

#include <string_view>

namespace voussoir::viewer {

// once a page, packed: the viewer, the report's figures and tables; then what unpacks and runs them, in their order
extern const std::string_view viewer_script, report_script, loading;
extern const std::string_view before_page, after_page;  // around scripts and fragment
// a report: before its data in base64, and after it; around its fragment
extern const std::string_view before_report, after_report_data, before_blocks, after_blocks;
// a fragment: the initial view, a poster with its type or none, the data, each in base64
extern const std::string_view before_look, before_poster, before_data, after_fragment;

}  // namespace voussoir::viewer
