// XML, one tag or text after the other, without a tree: files of millions of triangles would make
// one of gigabytes.
#pragma once

#include <string_view>

namespace whittle {

/// Names come without their prefixes. Comments, declarations and processing instructions are
/// skipped. Texts and values come as they are written, references in them too: numbers and names
/// have none. Whether tags match is not checked, only that as many are closed as opened.
class XmlScanner {
 public:
  enum class Event {
    kOpen,   ///< of an element: name(), next_attribute()
    kClose,  ///< of an element: name()
    kText,   ///< other than white space: text()
    kEnd,
    kMistake,  ///< this is no XML, or not all of it; there is no more
  };

  explicit XmlScanner(std::string_view content);

  Event next();
  std::string_view name() const { return name_; }
  std::string_view text() const { return text_; }

  struct Attribute {
    std::string_view name, value;
    std::string_view full_name;  ///< with its prefix, if it has one
  };
  /// The next attribute of the element just opened; false: there are no more.
  bool next_attribute(Attribute& attribute);

  /// The content from the last opened element's tag on.
  std::string_view from_tag() const { return {tag_, size_t(rest_.data() + rest_.size() - tag_)}; }

 private:
  Event tag();
  bool skip_behind(std::string_view mark);
  void skip_space();
  std::string_view take_name();
  bool is_at(std::string_view mark) const { return rest_.starts_with(mark); }

  std::string_view rest_, name_, full_name_, text_;
  const char* tag_;  ///< of the last opened element, in the content
  size_t depth_ = 0;
  bool in_tag_ = false;    ///< of an element just opened, whose attributes may follow
  bool is_empty_ = false;  ///< the element just opened has no content: `<a/>`
  bool is_broken_ = false;
};

}  // namespace whittle
