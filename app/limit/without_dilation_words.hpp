// What `voussoir limit` says of joints that slip without opening.
#pragma once

#include "app/limit/decide.hpp"
#include "app/limit/limit_answer.hpp"
#include "core/limit/without_dilation.hpp"

namespace voussoir {

// They put the answer of joints that slip without opening first: NAME_least and NAME_largest, and NAME where the two
// agree to 1 %, in front of what joints that dilate carry. The question is answered if both ends agree within their
// error bars.
void tell_factor_ends(const FactorEnds& found, LimitAnswer& answer);
void tell_strength_ends(const LimitRequest& request, const StrengthEnds& found, LimitAnswer& answer);

// The plain name holds what runs on elastic joints found.
void tell_decision(const LimitRequest& request, const Decision& found, LimitAnswer& answer);

}  // namespace voussoir
