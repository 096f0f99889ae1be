// Names of our own methods in the benchmark and its report.
#pragma once

namespace voussoir::benchmarks {

inline constexpr const char* single_cold = "voussoir single cold";
inline constexpr const char* single_warm = "voussoir single warm 1 %";
inline constexpr const char* single_warm_far = "voussoir single warm 10 %";
inline constexpr const char* batched_cold = "voussoir batched cold";
inline constexpr const char* batched_warm = "voussoir batched warm 1 %";
inline constexpr const char* batched_warm_far = "voussoir batched warm 10 %";
inline constexpr const char* batched_warm_threads = "voussoir batched warm 1 % 2 threads";
inline constexpr const char* batched_warm_2d = "voussoir 2-D batched warm 1 %";  // polygons in place of prisms
inline constexpr const char* single_warm_path = "voussoir on the central path single warm 1 %";
inline constexpr const char* batched_warm_path = "voussoir on the central path batched warm 1 %";
inline constexpr const char* own_lp = "voussoir LP cold";
inline constexpr const char* own_lp_warm = "voussoir LP warm 1 %";
inline constexpr const char* own_centre = "voussoir Newton from the LP's point";

// of the regions of Fig. 4.10
inline constexpr const char* solid_centre = "analytic centre from a feasible start";
inline constexpr const char* solid_lp_and_centre = "LP and analytic centre";
inline constexpr const char* solid_centroid = "centroid by exact clip";

inline constexpr const char* glpk_primal = "GLPK primal cold";
inline constexpr const char* glpk_dual_cold = "GLPK dual cold";
inline constexpr const char* glpk_dual_warm = "GLPK dual warm 1 %";
inline constexpr const char* ipopt_centre = "Ipopt from the LP's point";
inline constexpr const char* ccd_gjk = "libccd GJK";
inline constexpr const char* ccd_epa = "libccd GJK+EPA";
inline constexpr const char* ccd_mpr = "libccd MPR";
inline constexpr const char* fcl_contact = "FCL collide+contact";
inline constexpr const char* bullet_epa = "Bullet GjkEpa2";
inline constexpr const char* hand_clip = "hand clip and centroid";

}  // namespace voussoir::benchmarks
