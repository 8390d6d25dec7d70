// What the commands that ask about a model share: the model, opened, and what is seen of it.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "command_line.h"
#include "json_of.h"
#include "model/instances.h"

namespace whittle {

struct InquiryArguments {
  std::string file;
  Loading loading;
  ViewOptions view;
  Style style = ShadeSettings{}.style;  ///< of the picture that is asked about
  RendererSettings renderer;
  bool wants_json = false;
};
/// FILE, --json, and the options of reading and of the machine.
void add_inquiry_options(CommandLine& line, InquiryArguments& a);
/// The options of the picture that is asked about: its view, and the style that frames it.
void add_picture_options(CommandLine& line, InquiryArguments& a);
/// To be called when the command line has been read: the style's framing and curves.
void settle_picture(InquiryArguments& a);

/// A place in the picture, pixels from its top left corner.
struct Position {
  double x = 0, y = 0;
};
/// What --at says.
Position parse_position(const std::string& text);
/// Fails if the picture does not have one of the places.
Status check_positions(std::span<const Position> positions, const ViewOptions& view);

/// What is seen somewhere.
struct Picked {
  SurfaceCrossing hit;
  Vec3 point;  ///< world space
};

/// The statement whose surface is seen, and what it stands for.
struct Subject {
  std::string place;      ///< file:line:column; empty if the text is not the user's
  std::string statement;  ///< its beginning; empty if the text is not there any more
  std::string kind;       ///< of its primitive; "body" if it is made of several
  nlohmann::ordered_json parameters;
  std::optional<Rgba> color;
};

/// A number, or three, in as many digits as are needed.
std::string text_of(double number);
std::string text_of(Vec3 v);

class Inquiry {
 public:
  /// Reads the file, says its warnings, and is ready to ask.
  static Result<std::unique_ptr<Inquiry>> open(const InquiryArguments& a);

  const Model& model() const { return read_.model; }
  /// The exit code, if all else went well.
  int code() const { return code_for(read_, loading_, "answer"); }

  /// What is seen at a position of the picture; none if nothing is.
  Result<std::optional<Picked>> pick(const Position& at);
  Status cast(std::span<const Ray> rays, std::span<Hit> hits);
  Status cast_through(std::span<const Ray> rays, RayCrossings& found);

  Subject subject(uint32_t id) const;
  /// The diameter, at that point, of the round wall that it lies on, model units. None if there is
  /// no such wall, or if it is not round there.
  std::optional<double> diameter_at(const Picked& picked) const;
  /// How much material there is behind a surface, straight down from it.
  Result<std::optional<double>> thickness_at(const Picked& picked);

 private:
  Inquiry(const Loading& loading, Read read) : loading_(loading), read_(std::move(read)) {}

  const Loading& loading_;
  Read read_;
  std::optional<Renderer> renderer_;
  Camera camera_;
  std::vector<Instance> instances_;
  std::vector<SourceLocation> places_;  ///< by id
  std::vector<Appearance> looks_;       ///< by id
};

}  // namespace whittle
