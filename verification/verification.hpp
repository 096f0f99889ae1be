#pragma once
// All that a case's test needs: the comparison rule, the check, and the report that asserts and records verdict rows.
#include "verification/case_report.hpp"
#include "verification/comparison/comparison.hpp"
