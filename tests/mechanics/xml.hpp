// A small reader of XML, for tests that look into the files we write. Throws on what is not well formed.
#pragma once
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace hg::test {

struct Xml {
  std::string name, text;
  std::map<std::string, std::string> attributes;
  std::vector<Xml> children;

  const std::string &at(const std::string &attribute) const { return attributes.at(attribute); }
  std::vector<const Xml *> all(const std::string &tag) const {
    std::vector<const Xml *> found;
    for (const Xml &c : children) {
      if (c.name == tag) found.push_back(&c);
    }
    return found;
  }
  const Xml &one(const std::string &tag) const {
    const auto found = all(tag);
    if (found.size() != 1) throw std::runtime_error(name + " has " + std::to_string(found.size()) + " of " + tag);
    return *found[0];
  }
  /// The child of this tag whose Name is `wanted`.
  const Xml &named(const std::string &tag, const std::string &wanted) const {
    for (const Xml *c : all(tag)) {
      if (c->at("Name") == wanted) return *c;
    }
    throw std::runtime_error(name + " has no " + tag + " named " + wanted);
  }
};

class XmlReader {
 public:
  static Xml file(const std::string &path) {
    std::ifstream in(path);
    if (!in) throw std::runtime_error("no file " + path);
    std::stringstream buffer;
    buffer << in.rdbuf();
    XmlReader reader(buffer.str());
    reader.skip();
    Xml root = reader.element();
    reader.skip();
    if (reader.at_ != reader.text_.size()) throw std::runtime_error(path + ": text after the root element");
    return root;
  }

 private:
  explicit XmlReader(std::string text) : text_(std::move(text)) {}

  [[noreturn]] void bad(const std::string &what) const {
    throw std::runtime_error("XML at byte " + std::to_string(at_) + ": " + what);
  }
  bool starts(const char *s) const { return text_.compare(at_, std::char_traits<char>::length(s), s) == 0; }
  void space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) at_++;
  }
  void past(const char *s) {
    const std::size_t end = text_.find(s, at_);
    if (end == std::string::npos) bad(std::string("no ") + s);
    at_ = end + std::char_traits<char>::length(s);
  }
  /// Blanks, comments, declarations.
  void skip() {
    for (;;) {
      space();
      if (starts("<!--")) {
        past("-->");
      } else if (starts("<?")) {
        past("?>");
      } else if (starts("<!DOCTYPE")) {
        past(">");
      } else {
        return;
      }
    }
  }
  std::string word() {
    const std::size_t from = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_')) at_++;
    if (from == at_) bad("a name was expected");
    return text_.substr(from, at_ - from);
  }
  Xml element() {
    if (!starts("<")) bad("< was expected");
    at_++;
    Xml e;
    e.name = word();
    for (space(); !starts(">") && !starts("/>"); space()) {
      const std::string key = word();
      if (!starts("=\"")) bad("=\" was expected");
      at_ += 2;
      const std::size_t from = at_;
      past("\"");
      if (!e.attributes.emplace(key, text_.substr(from, at_ - 1 - from)).second) bad("attribute twice: " + key);
    }
    if (starts("/>")) {
      at_ += 2;
      return e;
    }
    at_++;
    for (;;) {
      const std::size_t from = at_, next = text_.find('<', at_);
      if (next == std::string::npos) bad("no end of " + e.name);
      e.text += text_.substr(from, next - from);
      at_ = next;
      if (starts("<!--")) {
        past("-->");
      } else if (starts("</")) {
        at_ += 2;
        if (word() != e.name) bad("another element ends than " + e.name);
        if (!starts(">")) bad("> was expected");
        at_++;
        return e;
      } else {
        e.children.push_back(element());
      }
    }
  }

  std::string text_;
  std::size_t at_ = 0;
};

}  // namespace hg::test
