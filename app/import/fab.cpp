// FracMan's fractures in ASCII. Sections are between BEGIN and END; a fracture is a line "id corners set
// properties…", its corners "number x y z", and a line "0 nx ny nz" with the normal.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>

#include "app/import/formats.hpp"
#include "app/import/units.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

constexpr double another_plane = 1 * degree;  // between a stated normal and the corners' plane; worth a remark

class FabReader {
 public:
  FabReader(std::string_view text, const Vector<3>& shift) : lines_(text), place_(shift) {}

  ImportedJoints read() {
    while (next()) {
      if (upper_case(words_[0].text) != "BEGIN" || words_.size() < 2)
        refuse(words_[0],
               "found " + shown(words_[0].text) + " in place of the begin of a section; is it an ASCII .fab?");
      const std::string section = upper_case(words_[1].text);
      const int begun = lines_.number();
      while (next_inside(section, begun)) {
        if (section == "FORMAT") format();
        if (section == "SETS") set_name();
        if (section == "FRACTURE") fracture();
        if (section == "TESSFRACTURE") tessellated();
        if (section == "ROCKBLOCK") refuse(words_[0], "rock blocks are no fractures; export the fractures alone");
      }
    }
    if (stated_ > 0 && stated_ != read_)
      throw FileFault(stated_line_, 0,
                      fmt::format("No_Fractures = {} but the file has {}; is it truncated?", stated_, read_));
    if (turned_ > 0)
      joints_.remark(
          fmt::format("{} stated normals differ from those of their corners' planes, which were used", turned_));
    place_.tell(joints_);
    joints_.remark(
        "FracMan cuts fractures at the faces of its region: edges there are not the true ends of the joints");
    return joints_.finish();
  }

 private:
  [[noreturn]] static void refuse(const Word& word, const std::string& reason) {
    throw FileFault(word.line, word.column, reason);
  }
  bool next() {
    while (lines_.next()) {
      words_ = words_of(lines_.line(), lines_.number());
      if (!words_.empty()) return true;
    }
    return false;
  }
  bool next_inside(const std::string& section, int begun) {
    if (!next())
      throw FileFault(lines_.number(), 0,
                      fmt::format("the file ends within BEGIN {} of line {}; is it truncated?", shown(section), begun));
    if (upper_case(words_[0].text) != "END") return true;
    if (words_.size() < 2 || upper_case(words_[1].text) != section)
      refuse(words_[0], "ends a section other than " + shown(section) + ", which is open; write END " + section);
    return false;
  }
  void need(std::size_t words, const char* what) {
    if (!next()) throw FileFault(lines_.number(), 0, fmt::format("the file ends before {}; is it truncated?", what));
    if (words_.size() < words) refuse(words_[0], fmt::format("{} must be here, {} words", what, words));
  }
  long long count(const Word& word, const std::string& what) const {
    constexpr double largest = 1e6;
    const double number = number_of(word, what);
    if (!(number >= 0 && number <= largest && number == std::floor(number)))
      refuse(word, what + " = " + shown(word.text) + ": must be a whole number from 0 on");
    return static_cast<long long>(number);
  }

  // `key = value` with or without blanks, the key in upper case and the value without quotes; nothing if the line has
  // no value
  std::optional<std::pair<std::string, Word>> assignment() const {
    const std::string_view line = lines_.line();
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) return std::nullopt;
    constexpr std::string_view blanks = " \t";
    const auto trimmed = [&](std::size_t from, std::size_t to, std::string_view edges) {
      while (from < to && edges.find(line[from]) != std::string_view::npos)
        ++from;
      while (to > from && edges.find(line[to - 1]) != std::string_view::npos)
        --to;
      return Word{line.substr(from, to - from), lines_.number(), static_cast<int>(from) + 1};
    };
    const Word value = trimmed(equals + 1, line.size(), " \t\"");
    if (value.text.empty()) return std::nullopt;
    return std::pair{upper_case(trimmed(0, equals, blanks).text), value};
  }
  void format() {
    const auto stated = assignment();
    if (!stated) return;
    const auto& [key, value] = *stated;
    const std::string word = upper_case(value.text);
    if (key == "FORMAT" && word != "ASCII") refuse(value, "Format = " + shown(value.text) + ": export it as Ascii");
    if (key == "XAXIS" && word != "EAST")
      refuse(value, "XAxis = " + shown(value.text) + ": x is east here; export it with XAxis = East");
    if (key == "LENGTH_UNIT" && read_ > 0) refuse(value, "Length_Unit must be stated before the fractures");
    if (key == "LENGTH_UNIT") place_.named_unit(value, "Length_Unit");
    if (key != "NO_FRACTURES") return;
    stated_ = count(value, "No_Fractures");
    stated_line_ = value.line;
  }
  // the number of a set, a fracture or a corner may be written as a float
  static std::string number_text(std::string_view text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool whole = error == std::errc() && end == text.data() + text.size() && number == std::floor(number);
    return whole ? fmt::format("{:.0f}", number) : std::string(text);
  }
  // Set1 = "a name"
  void set_name() {
    const auto stated = assignment();
    if (!stated || !stated->first.starts_with("SET")) return;
    const std::size_t number = stated->first.find_first_not_of(" \t", 3);
    if (number != std::string::npos) sets_[number_text(stated->first.substr(number))] = stated->second.text;
  }
  Vector<3> point() const {
    return {coordinate_of(words_[1], "x"), coordinate_of(words_[2], "y"), coordinate_of(words_[3], "z")};
  }
  void fracture() {
    if (words_.size() < 3) refuse(words_[0], "a fracture begins with its number, its corners' number and its set");
    const std::string set = number_text(words_[2].text);
    const JointSource origin{words_[0].line, "fracture-" + number_text(words_[0].text),
                             sets_.contains(set) ? sets_[set] : "set-" + set};
    const long long corners = count(words_[1], "number of corners");
    std::vector<Vector<3>> loop;
    for (long long k = 0; k < corners; ++k) {
      need(4, "a corner of the fracture (number, x, y, z)");
      if (count(words_[0], "number of the corner") != k + 1 && count(words_[0], "number of the corner") != k)
        refuse(words_[0],
               fmt::format("number of the corner = {}: must be {}; is a line missing?", shown(words_[0].text), k + 1));
      loop.push_back(place_(point(), words_[0].line));
    }
    need(4, "the normal of the fracture (0, x, y, z)");
    if (number_text(words_[0].text) != "0")
      refuse(words_[0], "the normal of the fracture must be here, a line that begins with 0");
    const Vector<3> normal = point();
    ++read_;
    if (const auto plane = fitted_plane(loop))
      turned_ += plane->normal.cross(normal).norm() > std::sin(another_plane) * normal.norm();
    joints_.polygon(origin, loop);
  }
  // "id nodes faces set", then a line for each node and face
  void tessellated() {
    if (words_.size() < 4) refuse(words_[0], "a tessellated fracture begins with its number, nodes, faces and set");
    joints_.drop(words_[0].line, "a tessellated fracture, which is no plane; export polygons");
    const long long lines = count(words_[1], "number of nodes") + count(words_[2], "number of faces");
    for (long long k = 0; k < lines; ++k)
      need(4, "a node or face of the fracture");
  }

  LineReader lines_;
  FilePlacement place_;
  std::vector<Word> words_;
  JointCollector joints_{3};
  std::map<std::string, std::string> sets_;
  long long stated_ = 0, read_ = 0, turned_ = 0;
  int stated_line_ = 0;
};

}  // namespace

ImportedJoints read_fab(std::string_view text, const Vector<3>& shift) {
  return FabReader(text, shift).read();
}

}  // namespace voussoir
