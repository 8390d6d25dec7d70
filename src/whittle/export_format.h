// What a file can be that is written: a picture, the solid, a drawing, or a film.
#pragma once

#include <string_view>
#include <variant>

#include "boundary/write_solid.h"
#include "flat/write_drawing.h"
#include "whittle/choices.h"

namespace whittle {

using ExportFormat = std::variant<FileFormat, SolidFormat, DrawingFormat, FilmFormat>;

/// By OpenSCAD's names for --export-format.
Choices<ExportFormat> export_format_choices();

/// The format that a file name asks for by its ending (upper and lower case count alike). A kUsage
/// error names the endings there are.
Result<ExportFormat> export_format_of(std::string_view path);

/// The endings there are, as in ".png, .exr or .stl".
std::string export_endings();

}  // namespace whittle
