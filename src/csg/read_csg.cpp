#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "csg/check_text.h"
#include "csg/read_csg.h"
#include "csg/reader.h"
#include "evaluate/background.h"
#include "evaluate/evaluate.h"
#include "model/document.h"

namespace whittle {
namespace {

constexpr std::string_view kFlatBackground = "what % marks is flat; it is not drawn";

}  // namespace

Result<Read> read_csg(std::string_view text, const std::string& file_name,
                      const ReadOptions& options) {
  const Result<std::string_view> checked = check_text(text, file_name, options.limits);
  if (!checked) return checked.error();
  TextInMemory source(*checked);
  return read_csg(source, file_name, options);
}

Result<Read> read_csg(TextSource& source, const std::string& file_name,
                      const ReadOptions& options) {
  Warnings warnings(file_name);
  Result<Document> document = read_document(source, file_name, options, warnings);
  if (!document) return document.error();
  const EvaluateOptions evaluating{.curves = options.curves,
                                   .most_facets = options.limits.facets,
                                   .threads = options.threads,
                                   .read_file = options.named_files,
                                   .outlines = options.outlines,
                                   .solid_box = options.solid_box,
                                   .closed_mesh = options.closed_mesh};
  StatementCounts counts = std::move(document->counts);
  Document background;
  if (options.background && counts.background > 0) background = background_of(*document);
  const bool has_background = background.model.nodes.size() > 1;
  const SourceLocation first_mark =
      has_background ? background.model.nodes[1].where : SourceLocation{};
  Result<Model> model = evaluate(std::move(*document), evaluating, warnings);
  if (!model) return model.error();
  Warnings of_background(file_name);
  if (has_background) {
    Result<Model> ghosts = evaluate(std::move(background), evaluating, of_background);
    if (!ghosts) return ghosts.error();
    if (ghosts->drawing)
      of_background.add(kFlatBackground, first_mark, kFlatBackground);
    else
      model->background = std::make_shared<const Model>(*std::move(ghosts));
  }
  const std::optional<Unsupported> unsupported = warnings.unsupported();
  std::string refusal;
  if (unsupported) {
    refusal =
        message_at(file_name, unsupported->where, fmt::format("error: {}", unsupported->message));
  }
  std::vector<std::string> said = warnings.take();
  for (std::string& warning : of_background.take()) said.push_back(std::move(warning));
  return Read{.model = std::move(*model),
              .counts = std::move(counts),
              .warnings = std::move(said),
              .unsupported = unsupported,
              .refusal = std::move(refusal),
              .missing_file = warnings.missing_file()};
}

}  // namespace whittle
