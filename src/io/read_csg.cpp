#include <optional>
#include <utility>

#include "evaluate/evaluate.h"
#include "io/csg_reader.h"
#include "io/csg_text.h"
#include "io/named_files.h"
#include "io/read.h"
#include "model/document.h"

namespace whittle {

Result<Read> read_csg(std::string_view text, const std::string& file_name,
                      const ReadOptions& options) {
  const Result<std::string_view> checked = check_text(text, file_name, options.limits);
  if (!checked) return checked.error();
  Warnings warnings(file_name);
  Result<Document> document = read_document(*checked, file_name, options, warnings);
  if (!document) return document.error();
  EvaluateOptions evaluating{.curves = options.curves,
                             .most_facets = options.limits.facets,
                             .read_file = nullptr,
                             .solid_box = options.solid_box};
  if (options.folder) {
    evaluating.read_file = named_files(*options.folder, options.import_root, options.limits.bytes);
  }
  Result<Model> model = evaluate(std::move(*document), evaluating, warnings);
  if (!model) return model.error();
  const std::optional<Unsupported> unsupported = warnings.unsupported();
  return Read{std::move(*model), warnings.take(), unsupported};
}

}  // namespace whittle
