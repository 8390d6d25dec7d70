#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>

#include "csg/check_text.h"
#include "csg/read_csg.h"
#include "csg/reader.h"
#include "evaluate/evaluate.h"
#include "model/document.h"

namespace whittle {

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
  Result<Model> model = evaluate(std::move(*document), evaluating, warnings);
  if (!model) return model.error();
  const std::optional<Unsupported> unsupported = warnings.unsupported();
  std::string refusal;
  if (unsupported) {
    refusal =
        message_at(file_name, unsupported->where, fmt::format("error: {}", unsupported->message));
  }
  return Read{.model = std::move(*model),
              .counts = std::move(counts),
              .warnings = warnings.take(),
              .unsupported = unsupported,
              .refusal = std::move(refusal),
              .missing_file = warnings.missing_file()};
}

}  // namespace whittle
