// Test help: a small reader of XML, with the appended numbers of VTK, that shares no code with the writer; sufficient
// to check its files.
#pragma once

#include <zlib.h>

#include <cctype>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace voussoir::test {

struct Element {
  std::string name, text;
  std::map<std::string, std::string> attributes;
  std::vector<Element> children;
  std::vector<double> appended;  // numbers of an array with format "appended"

  const Element& child(const std::string& wanted) const {
    for (const Element& element : children)
      if (element.name == wanted) return element;
    throw std::runtime_error("no element " + wanted + " in " + name);
  }
  const Element& named(const std::string& wanted) const {
    for (const Element& element : children)
      if (element.attributes.count("Name") && element.attributes.at("Name") == wanted) return element;
    throw std::runtime_error("no array " + wanted + " in " + name);
  }
  double number(const std::string& attribute) const { return std::stod(attributes.at(attribute)); }
  std::vector<double> numbers() const {
    if (attributes.count("format") && attributes.at("format") == "appended") return appended;
    std::istringstream stream(text);
    std::vector<double> list;
    for (double value; stream >> value;)
      list.push_back(value);
    if (!stream.eof()) throw std::runtime_error("not a number in " + name);
    return list;
  }
};

// throws std::runtime_error on anything that is not well formed
class XmlReader {
 public:
  explicit XmlReader(std::string text) : text_(std::move(text)) {}

  Element read() {
    cut_appended();
    expect("<?xml version=\"1.0\"?>");
    skip_space();
    Element root = element();
    skip_space();
    if (at_ != text_.size()) throw std::runtime_error("text after the root element");
    return root;
  }

 private:
  Element element() {
    Element result;
    expect("<");
    result.name = word();
    for (skip_space(); text_.at(at_) != '/' && text_.at(at_) != '>'; skip_space()) {
      const std::string key = word();
      expect("=\"");
      const std::size_t end = text_.find_first_of("\"<", at_);
      if (text_.at(end) != '"' || result.attributes.count(key)) throw std::runtime_error("bad attribute " + key);
      result.attributes[key] = text_.substr(at_, end - at_);
      at_ = end + 1;
    }
    if (text_.at(at_) == '/') {
      expect("/>");
      if (result.attributes.count("offset")) result.appended = appended_numbers(result.attributes);
      return result;
    }
    expect(">");
    for (;;) {
      const std::size_t tag = text_.find('<', at_);
      if (tag == std::string::npos) throw std::runtime_error("unclosed " + result.name);
      result.text += text_.substr(at_, tag - at_);
      at_ = tag;
      if (text_.compare(at_, 2, "</") == 0) break;
      result.children.push_back(element());
    }
    expect("</" + result.name + ">");
    return result;
  }

  // the raw bytes, which are no XML
  void cut_appended() {
    const std::string open = "<AppendedData encoding=\"raw\">\n_", close = "\n  </AppendedData>";
    const std::size_t begin = text_.find(open);
    if (begin == std::string::npos) return;
    const std::size_t first = begin + open.size(), end = text_.rfind(close);
    bytes_ = text_.substr(first, end - first);
    text_.erase(first - 1, end - first + 1);
  }

  template <class Number>
  static std::vector<double> numbers_in(const std::string& plain) {
    std::vector<Number> numbers(plain.size() / sizeof(Number));
    if (numbers.size() * sizeof(Number) != plain.size()) throw std::runtime_error("part of a number");
    std::memcpy(numbers.data(), plain.data(), plain.size());
    return {numbers.begin(), numbers.end()};
  }

  std::vector<double> appended_numbers(const std::map<std::string, std::string>& attributes) const {
    const std::string header = bytes_.substr(std::stoul(attributes.at("offset")), 4 * sizeof(std::uint64_t));
    std::uint64_t blocks, size, last, packed;
    std::memcpy(&blocks, header.data(), sizeof blocks);
    std::memcpy(&size, header.data() + 8, sizeof size);
    std::memcpy(&last, header.data() + 16, sizeof last);
    if (blocks == 0) return {};
    if (blocks != 1 || last != 0) throw std::runtime_error("not one whole block");
    std::memcpy(&packed, header.data() + 24, sizeof packed);
    std::string plain(size, 0);
    uLongf found = size;
    const std::string data = bytes_.substr(std::stoul(attributes.at("offset")) + header.size(), packed);
    if (uncompress(reinterpret_cast<Bytef*>(plain.data()), &found, reinterpret_cast<const Bytef*>(data.data()),
                   data.size()) != Z_OK ||
        found != size)
      throw std::runtime_error("not the bytes that the header promises");
    const std::string& type = attributes.at("type");
    return type == "Float64"   ? numbers_in<double>(plain)
           : type == "Float32" ? numbers_in<float>(plain)
           : type == "Int64"   ? numbers_in<std::int64_t>(plain)
                               : throw std::runtime_error("an array of " + type);
  }

  std::string word() {
    const std::size_t begin = at_;
    while (std::isalnum(static_cast<unsigned char>(text_.at(at_))) || text_[at_] == '_')
      ++at_;
    if (at_ == begin) throw std::runtime_error("a name was expected at byte " + std::to_string(at_));
    return text_.substr(begin, at_ - begin);
  }
  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])))
      ++at_;
  }
  void expect(const std::string& wanted) {
    if (text_.compare(at_, wanted.size(), wanted) != 0)
      throw std::runtime_error("'" + wanted + "' was expected at byte " + std::to_string(at_));
    at_ += wanted.size();
  }

  std::string text_, bytes_;
  std::size_t at_ = 0;
};

}  // namespace voussoir::test
