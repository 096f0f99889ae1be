#include "reports/trade_page.hpp"

#include "reports/built_text.hpp"

namespace voussoir::reports {

std::string trade_page(const Folders& folders, std::vector<std::string>& missing) {
  return "<section class=\"case\" id=\"what-accuracy-costs\">\n<h2>Cost of accuracy</h2>\n" +
         built_text(folders.build / "reports" / "studies" / "trade.md", 0,
                    "No study was compared: `make reports` runs them.", "cost of accuracy", missing) +
         "</section>\n";
}

std::string checks_page(const Folders& folders, std::vector<std::string>& missing) {
  return "<section class=\"case\" id=\"all-checks\">\n<h2>All checks at a glance</h2>\n" +
         built_text(folders.build / "reports" / "checks" / "checks.md", 0,
                    "The checks were not gathered: `make reports` does it.", "all checks", missing) +
         "</section>\n";
}

}  // namespace voussoir::reports
