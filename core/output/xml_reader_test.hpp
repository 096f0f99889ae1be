// Test help: a small XML reader that shares no code with the writer, sufficient to check its files.
#pragma once

#include <cctype>
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

  std::string text_;
  std::size_t at_ = 0;
};

}  // namespace voussoir::test
