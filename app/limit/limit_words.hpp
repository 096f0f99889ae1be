// What `voussoir limit` refuses, warns of and says of its results, alike in the plane and in space.
#pragma once

#include "app/base/run_scene.hpp"
#include "app/limit/limit_answer.hpp"

namespace voussoir {

// Throws BadInput for particles, bolts and linings.
template <int Dim>
void refuse_what_limit_leaves_out(const Prepared<Dim>& prepared);

// blocks that no face can support, however rough; `touched`: by body, whether a face touches another block's
template <int Dim>
void warn_of_unsupported(const Model<Dim>& model, const std::vector<bool>& touched, std::vector<std::string>& warnings);

// strengths other than friction that are left out; `cohesive`: by properties, whether cohesion of a face counts
void warn_of_strengths(const std::vector<JointProperties>& properties, const std::vector<bool>& cohesive,
                       std::vector<std::string>& warnings);

// The stage whose applied forces are analysed if they are asked for: the first that states any. Throws BadInput if none
// does.
const StagePlan* stage_of_forces(const std::vector<StagePlan>& stages, const LimitRequest& request);

// changes by stages are left out, except the forces of the stage `analysed`, if any
void warn_of_changes(const std::vector<StagePlan>& stages, const StagePlan* analysed,
                     std::vector<std::string>& warnings);

// Throws BadInput for a name that no properties have, and for a critical friction of joints whose friction depends on
// stress.
void refuse_unknown_properties(const LimitRequest& request, const std::vector<JointProperties>& properties);

// What joints that dilate carry: NAME_upper_bound, of a friction angle NAME_lower_bound.
// `cohesive`: the factor divides cohesion, too; `rule`: how the bracket was found
void tell_factor_of_safety(const LimitRequest& request, const StrengthBracket& found, bool cohesive,
                           const std::string& rule, LimitAnswer& answer);
void tell_friction(const LimitRequest& request, const StrengthBracket& found, const std::string& rule,
                   LimitAnswer& answer);
// `if_any`: the reason, or the repair, if any factor is carried
void tell_load_factor(LimitStatus status, double factor, const std::string& rule, const std::string& if_any,
                      LimitAnswer& answer);

// How joints after Barton and Bandis were counted, if there are any.
void tell_envelope(LimitAnswer& answer);

// What any factor of gravity or of the applied forces is due to, and the words for these loads.
extern const char* const any_gravity;
extern const char* const any_applied;
std::string sought_of_applied(const StagePlan& stage);
extern const char* const sought_of_gravity;

// Throws BadInput if there is nothing to analyse.
void refuse_empty(const LimitAnswer& answer, bool weightless, const StagePlan* analysed);

}  // namespace voussoir
