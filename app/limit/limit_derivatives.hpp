// What moves the answer of a limit analysis: derivatives of its first value.
#pragma once

#include "app/derivatives/derivative_table.hpp"
#include "app/limit/limit_analysis.hpp"

namespace voussoir {

// `analysis`: the answer of the scene to the same request. Its first value is differentiated, with its error bar.
// Proofs and decisions by runs are left out.
template <int Dim>
DerivativeTable limit_derivatives(const LoadedScene& scene, const LimitRequest& request,
                                  const LimitAnalysis<Dim>& analysis, const KeyHook& hook = {});

}  // namespace voussoir
