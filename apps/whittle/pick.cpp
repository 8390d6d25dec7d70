// whittle pick FILE --at X,Y: what is seen at a place of the picture.
#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/printable.h"
#include "commands.h"
#include "console.h"
#include "inquiry.h"

namespace whittle {
namespace {

constexpr CommandHelp kHelp = {
    "whittle pick", "Says what is seen at places of a picture: which statement, and where.",
    "FILE --at X,Y [--at X,Y ...] [options]",
    "X,Y are pixels of the picture that whittle FILE makes with the same view and\n"
    "style; 0,0 is its top left corner.\n\n"
    "Examples:\n"
    "  whittle pick part.csg --at 256,256\n"
    "  whittle pick part.csg --at 400.5,300.5 --imgsize 800,600 --json\n\n"
    "Exit codes: 0 done, 1 bad input, or something in it is not shown (--lenient: 0),\n"
    "2 bad usage, 3 refused by the machine."};

std::string describe_text(const Inquiry& inquiry, const Position& at,
                          const std::optional<Picked>& picked) {
  if (!picked) return fmt::format("{},{}: nothing is seen there\n", text_of(at.x), text_of(at.y));
  const Subject subject = inquiry.subject(picked->hit.id);
  std::string text;
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty())
      fmt::format_to(std::back_inserter(text), "{:<10} {}\n", name, printable(value));
  };
  add("statement", subject.statement);
  add("place", subject.place);
  add("point", text_of(picked->point));
  add("normal", text_of(picked->hit.normal));
  add("distance", text_of(picked->hit.distance));
  add("id", fmt::format("{}", inquiry.statement_of(picked->hit.id)));
  if (inquiry.is_cap(picked->hit.id)) add("section", "where it is cut open");
  std::string kind = subject.kind;
  for (const auto& [name, value] : subject.parameters.items())
    kind += fmt::format(", {} {}", name, value.dump());
  add("primitive", kind);
  if (subject.color) {
    add("color", fmt::format("{:.4g},{:.4g},{:.4g},{:.4g}", subject.color->r, subject.color->g,
                             subject.color->b, subject.color->a));
  }
  return text;
}

std::string describe_json(const Inquiry& inquiry, const Position& at,
                          const std::optional<Picked>& picked) {
  nlohmann::ordered_json json;
  json["at"] = {at.x, at.y};
  json["hit"] = picked.has_value();
  if (picked) {
    const Subject subject = inquiry.subject(picked->hit.id);
    const auto text_or_null = [](const std::string& text) {
      return text.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(text);
    };
    json["id"] = inquiry.statement_of(picked->hit.id);
    if (inquiry.model().cut) json["section"] = inquiry.is_cap(picked->hit.id);
    json["place"] = text_or_null(subject.place);
    json["statement"] = text_or_null(subject.statement);
    json["point"] = json_of(picked->point);
    json["normal"] = json_of(picked->hit.normal);
    json["distance"] = picked->hit.distance;
    json["primitive"] = {{"kind", subject.kind}, {"parameters", subject.parameters}};
    json["color"] = nullptr;
    if (const auto& c = subject.color) json["color"] = {c->r, c->g, c->b, c->a};
  }
  // A file name may be any bytes; JSON may not.
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace

int pick_command(Arguments arguments) {
  CommandLine line(kHelp);
  InquiryArguments a;
  std::vector<Position> places;
  line.add_required("FILE", a.file);
  OptionGroup(line.app(), "What is asked")
      .add_each("--at", "X,Y", "a place in the picture, pixels; may be given again",
                [&](const std::string& text) { places.push_back(parse_position(text)); });
  add_picture_options(line, a);
  add_inquiry_options(line, a);
  if (const std::optional<int> code = line.parse(arguments)) return *code;
  if (places.empty()) return report({ErrorKind::kUsage, "pick needs a place: --at X,Y"});
  if (Status inside = check_positions(places, a.view); !inside) return report(inside.error());
  settle_picture(a);

  const Result<std::unique_ptr<Inquiry>> opened = Inquiry::open(a);
  if (!opened) return report(opened.error());
  Inquiry& inquiry = **opened;
  std::string text;
  for (const Position& at : places) {
    const Result<std::optional<Picked>> picked = inquiry.pick(at);
    if (!picked) return report(picked.error());
    if (!a.wants_json && &at != &places[0]) text += '\n';
    text +=
        a.wants_json ? describe_json(inquiry, at, *picked) : describe_text(inquiry, at, *picked);
  }
  const int printed = print(text);
  return printed != kExitDone ? printed : inquiry.code();
}

}  // namespace whittle
