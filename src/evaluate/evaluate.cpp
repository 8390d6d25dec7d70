#include "evaluate/evaluate.h"

#include <fmt/format.h>

#include <utility>

#include "evaluate/budget.h"
#include "evaluate/evaluator.h"
#include "evaluate/polyhedra.h"
#include "model/instances.h"

namespace whittle {

Result<Model> evaluate(Document document, const EvaluateOptions& options, Warnings& warnings) {
  Budget budget(options.most_facets);
  SourceLocation where;
  const auto too_much = [&] {
    return Error{ErrorKind::kInput,
                 message_at(document.model.file, where, "error: " + budget.message())};
  };
  build_polyhedra(document.model, options.threads, budget, warnings, where);
  if (budget.is_spent()) return too_much();
  const bool is_model = document.leaves.empty() && document.operations.empty();
  Model model;
  if (is_model) {
    model = std::move(document.model);
  } else {
    Projections projections;
    model = Evaluator(document, options, budget, warnings, projections).run(where);
    if (budget.is_spent()) return too_much();
    if (model.drawing && options.outlines) {
      Warnings said_before(document.model.file);
      budget = Budget(options.most_facets);  // The same shapes once more are no more faces.
      model.drawing->outlines =
          Evaluator(document, options, budget, said_before, projections).outlines(where);
      if (budget.is_spent()) return too_much();
    }
  }
  for (std::string& warning : transform_warnings(model)) {
    warnings.add_full("a transform leaves nothing of what it moves", std::move(warning));
  }
  return model;
}

}  // namespace whittle
