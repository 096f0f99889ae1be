// Tables with any names, read back by other programs: gnuplot, numpy, and Python's csv, which reads them as a
// spreadsheet does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "app/testing/program.hpp"
#include "core/testing/shapes.hpp"
#include "text/csv_table.hpp"

namespace voussoir::table_readers_test {
namespace {

using namespace program;

std::vector<std::string> nasty_names(std::size_t count) {
  const std::vector<std::string> letters{"#", "'", "\"", ",", ";", "+", "-", "@", "`", "\\", "{", "}",
                                         "_", "^", "$",  "%", "&", "(", ")", "<", ">", "|",  "~", "!",
                                         "?", "*", " ",  "é", "µ", "a", "B", "7", "0", "n",  "e"};
  std::vector<std::string> names{"#rock",  "'rock", "''rock", "# 'a', \"b\"", "\"",     "say \"so\", twice",
                                 "`date`", "@a",    "+1+1",   "'-a",          "rock #2"};
  std::set<std::string> seen(names.begin(), names.end());
  shapes::Random random(18);
  while (names.size() < count) {
    std::string name;
    for (int k = shapes::integer(random, 1, 10); k > 0; --k)
      name += letters[shapes::integer(random, 0, static_cast<int>(letters.size()) - 1)];
    if (name.front() != ' ' && name.back() != ' ' && seen.insert(name).second) names.push_back(name);
  }
  return names;
}

std::string in_toml(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text)
    quoted += (c == '"' || c == '\\' ? "\\" : "") + std::string(1, c);
  return quoted + "\"";
}

// a spreadsheet shows a text that it would compute behind the apostrophe that keeps it a text
std::string in_a_spreadsheet(const std::string& name) {
  const std::size_t first = name.find_first_not_of('\'');
  const bool formula = first != std::string::npos && std::string("=+-@").find(name[first]) != std::string::npos;
  char* end = nullptr;
  std::strtod(name.c_str(), &end);
  return formula && *end != 0 ? "'" + name : name;
}

class TableReaders : public Program {
 protected:
  std::vector<std::string> written() const {
    std::string scene =
        "dimension = 3\ndensity = 2600\ngravity = [0, 0, -9.81]\ndomain = { box = { min = [0, 0, 0], max = [1, 1, 1] } "
        "}\n"
        "stage = [{ name = \"settle\", kind = \"settle\" }]\n";
    const std::vector<std::string> names = nasty_names(60);
    for (std::size_t k = 0; k < names.size(); ++k)
      scene += fmt::format(
          "[[joint_properties]]\nname = {}\nnormal_stiffness = 1e9\nshear_stiffness = 1e8\nfriction_deg = {}\n",
          in_toml(names[k]), 10 + k);
    write("scene.toml", scene);
    const Ended ended = run("joint-test scene.toml --out out --stress 1e6 --slip 0.02 --steps 4");
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.err, "");
    return names;
  }
  std::string python(const std::string& script) const {
    write("read.py", script);
    const std::string at = "cd '" + folder_.string() + "' && ";
    for (const char* program : {"/usr/bin/python3", "python3"})
      if (std::system((at + program + " read.py > python.txt 2> python_errors.txt").c_str()) == 0)
        return read(folder_ / "python.txt");
    ADD_FAILURE() << read(folder_ / "python_errors.txt");
    return "";
  }
};

TEST_F(TableReaders, NamesComeBack) {
  const std::vector<std::string> names = written();
  const CsvTable table = parse_csv(read(folder_ / "out/joint_test.csv"));
  ASSERT_EQ(table.rows.size() % names.size(), 0u);
  const std::size_t points = table.rows.size() / names.size();
  for (std::size_t k = 0; k < table.rows.size(); ++k)
    EXPECT_EQ(table.text(table.rows[k], "joint"), names[k / points]);
  for (const char* reader :
       {"import csv\nfor row in list(csv.reader(open('out/joint_test.csv', encoding='utf-8', newline='')))[1:]:\n"
        "    print(row[0])\n",
        "import numpy\nfor row in numpy.loadtxt('out/joint_test.csv', dtype=str, delimiter=',', quotechar='\"', "
        "skiprows=1, encoding='utf-8'):\n    print(row[0])\n"}) {
    const std::vector<std::string> found = lines_of(python(reader));
    ASSERT_EQ(found.size(), table.rows.size()) << reader;
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_EQ(found[k], in_a_spreadsheet(names[k / points])) << reader;
  }
}

// gnuplot's own numbers of the figure's curves are those of the table, and its key names them
TEST_F(TableReaders, TheFigureIsDrawnForAnyName) {
  const std::vector<std::string> names = written();
  const std::string figure = read(folder_ / "out/joint_test.svg");
  for (const std::string& name : names) {
    std::string in_xml;
    for (const char c : name)
      in_xml += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
    EXPECT_NE(figure.find(in_xml + ", 1 MPa"), std::string::npos) << name;
  }
  std::string script = read(folder_ / "out/joint_test.gp");
  script.replace(script.find("set datafile"), 0, "set table 'curves.txt'\n");
  write("out/curves.gp", script);
  ASSERT_EQ(std::system(("cd '" + (folder_ / "out").string() + "' && gnuplot curves.gp 2> errors.txt").c_str()), 0)
      << read(folder_ / "out/errors.txt");
  std::vector<std::pair<double, double>> drawn;
  for (const std::string& line : lines_of(read(folder_ / "out/curves.txt"))) {
    double x = 0, y = 0;
    if (!line.starts_with("#") && std::sscanf(line.c_str(), "%lf %lf", &x, &y) == 2) drawn.emplace_back(x, y);
  }
  const CsvTable table = parse_csv(read(folder_ / "out/joint_test.csv"));
  // the shear stress over the slip, and over the normal stress in the next panel, whose other curves are the strengths
  ASSERT_GT(drawn.size(), 2 * table.rows.size());
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    const double shear = 1e-6 * *table.number(table.rows[k], "shear_stress_Pa");
    EXPECT_NEAR(drawn[k].first, 1e3 * *table.number(table.rows[k], "slip_m"), 1e-4);  // printed to six digits
    EXPECT_NEAR(drawn[k].second, shear, 1e-5);
    const auto& path = drawn[table.rows.size() + k];
    EXPECT_NEAR(path.first, 1e-6 * *table.number(table.rows[k], "normal_stress_Pa"), 1e-5);
    EXPECT_NEAR(path.second, shear, 1e-5);
  }
}

}  // namespace
}  // namespace voussoir::table_readers_test
