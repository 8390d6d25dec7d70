#include "base/xml_scanner.h"

#include <algorithm>

namespace whittle {
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool ends_name(char c) {
  return is_space(c) || c == '/' || c == '>' || c == '=' || c == '<' || c == '"' || c == '\'';
}

}  // namespace

XmlScanner::XmlScanner(std::string_view content) : rest_(content), tag_(content.data()) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (is_at(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
}

void XmlScanner::skip_space() {
  const auto* const end = std::ranges::find_if_not(rest_, is_space);
  rest_.remove_prefix(size_t(end - rest_.begin()));
}

bool XmlScanner::skip_behind(std::string_view mark) {
  const size_t at = rest_.find(mark);
  if (at == std::string_view::npos) return false;
  rest_.remove_prefix(at + mark.size());
  return true;
}

std::string_view XmlScanner::take_name() {
  const auto* const end = std::ranges::find_if(rest_, ends_name);
  full_name_ = rest_.substr(0, size_t(end - rest_.begin()));
  rest_.remove_prefix(full_name_.size());
  return full_name_.substr(full_name_.find(':') + 1);
}

bool XmlScanner::next_attribute(Attribute& attribute) {
  if (!in_tag_) return false;
  skip_space();
  if (is_at("/>") || is_at(">")) {
    is_empty_ = is_at("/");
    rest_.remove_prefix(is_empty_ ? 2 : 1);
    in_tag_ = false;
    return false;
  }
  attribute.name = take_name();
  attribute.full_name = full_name_;
  skip_space();
  is_broken_ = true;
  if (attribute.name.empty() || !is_at("=")) return in_tag_ = false;
  rest_.remove_prefix(1);
  skip_space();
  if (!is_at("\"") && !is_at("'")) return in_tag_ = false;
  const size_t end = rest_.find(rest_[0], 1);
  if (end == std::string_view::npos) return in_tag_ = false;
  attribute.value = rest_.substr(1, end - 1);
  rest_.remove_prefix(end + 1);
  is_broken_ = false;
  return true;
}

XmlScanner::Event XmlScanner::tag() {
  const char* const begin = rest_.data();
  rest_.remove_prefix(1);
  if (is_at("/")) {
    rest_.remove_prefix(1);
    name_ = take_name();
    skip_space();
    if (name_.empty() || !is_at(">") || depth_ == 0) return Event::kMistake;
    rest_.remove_prefix(1);
    --depth_;
    return Event::kClose;
  }
  name_ = take_name();
  if (name_.empty()) return Event::kMistake;
  tag_ = begin;
  ++depth_;
  in_tag_ = true;
  is_empty_ = false;
  return Event::kOpen;
}

XmlScanner::Event XmlScanner::next() {
  Attribute skipped;
  while (next_attribute(skipped)) {
  }
  if (is_empty_) {
    is_empty_ = false;
    --depth_;
    return Event::kClose;
  }
  while (!is_broken_ && !rest_.empty()) {
    if (is_at("<!--")) {
      is_broken_ = !skip_behind("-->");
    } else if (is_at("<?")) {
      is_broken_ = !skip_behind("?>");
    } else if (is_at("<![CDATA[")) {
      rest_.remove_prefix(std::string_view("<![CDATA[").size());
      text_ = rest_.substr(0, rest_.find("]]>"));
      is_broken_ = !skip_behind("]]>");
      if (!is_broken_) return Event::kText;
    } else if (is_at("<!")) {
      // A document type has angle brackets of its own only between square ones.
      const size_t square = rest_.find('['), end = rest_.find('>');
      is_broken_ = !(square < end ? skip_behind("]") && skip_behind(">") : skip_behind(">"));
    } else if (is_at("<")) {
      const Event event = tag();
      is_broken_ = event == Event::kMistake;
      return event;
    } else {
      text_ = rest_.substr(0, rest_.find('<'));
      rest_.remove_prefix(text_.size());
      const auto* const first = std::ranges::find_if_not(text_, is_space);
      text_.remove_prefix(size_t(first - text_.begin()));
      while (!text_.empty() && is_space(text_.back())) text_.remove_suffix(1);
      if (!text_.empty()) return Event::kText;
    }
  }
  return is_broken_ || depth_ > 0 ? Event::kMistake : Event::kEnd;
}

}  // namespace whittle
