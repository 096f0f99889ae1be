// A judgement as tables over codes, and as a figure.
#pragma once

#include <string>

#include "app/judge/judgement.hpp"

namespace voussoir {

// "12 passed, 1 failed, 2 not run, 3 cannot state, 0 faulty", of one code or, if it is empty, of all
std::string judgement_counts(const Judgement& judgement, const std::string& code = {});

std::string judgement_markdown(const Judgement& judgement);

// a page that needs no other file
std::string judgement_html(const Judgement& judgement, const std::string& figure);

// problem,quantity,unit,code,verdict,value,lower,upper,error,tolerance,seconds,note
std::string judgement_csv(const Judgement& judgement);

// SVG: the error in tolerances (1 is the limit) against the seconds that the answer states, both on logarithmic axes; a
// colour for each code, a mark for each problem. Empty if no judged row has seconds.
std::string error_against_cost(const Judgement& judgement);

}  // namespace voussoir
