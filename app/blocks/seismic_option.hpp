// The earthquake of `--seismic`: k, or k/trend in degrees.
#pragma once

#include <string>

#include "core/key_blocks/block_survey.hpp"

namespace voussoir {

// Throws BadInput.
SeismicRequest seismic_request(const std::string& text);

}  // namespace voussoir
