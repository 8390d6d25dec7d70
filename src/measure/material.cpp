#include "measure/material.h"

#include <utility>
#include <vector>

namespace whittle {
namespace {

/// How much of an operand is wanted.
enum class Share : uint8_t { kNone, kAll, kSome };

/// Writes formulas in prefix order. A group in one of its own kind is that one.
class FormulaWriter {
 public:
  size_t size() const { return out_.size(); }

  void open(TokenKind kind) {
    const bool joins = !groups_.empty() && groups_.back().kind == kind;
    if (!joins) out_.push_back(Token::make(kind, 0));
    groups_.push_back({kind, joins ? kJoined : out_.size() - 1});
  }
  void close() {
    const Group group = groups_.back();
    groups_.pop_back();
    if (group.header != kJoined)
      out_[group.header] = Token::make(group.kind, uint32_t(out_.size() - group.header));
  }
  /// An operand, or its complement.
  void copy(Operand operand, bool negated) {
    const TokenKind kind = operand.token().kind();
    if (!operand.is_group()) return put(operand.token(), negated);
    open(negated ? swapped(kind) : kind);
    for (const Token token : operand.tokens.subspan(1)) put(token, negated);
    close();
  }
  Formula take() { return std::move(out_); }

 private:
  static constexpr size_t kJoined = SIZE_MAX;
  struct Group {
    TokenKind kind;
    size_t header;
  };
  static TokenKind swapped(TokenKind kind) {
    return kind == TokenKind::kAnd ? TokenKind::kOr : TokenKind::kAnd;
  }
  void put(Token token, bool negated) {
    if (!negated || token.is_pass())
      out_.push_back(token);
    else if (token.is_group())
      out_.push_back(Token::make(swapped(token.kind()), token.payload()));
    else
      out_.push_back(Token::make(token.kind(), token.payload(), !token.negated()));
  }

  Formula out_;
  std::vector<Group> groups_;
};

class MaterialWriter {
 public:
  MaterialWriter(const Scene& scene, const std::function<bool(uint32_t)>& is_wanted)
      : formula_(scene.formula), shares_(scene.formula.size()) {
    find_shares(scene, is_wanted);
  }

  Result<Formula> write(size_t most_tokens) {
    const Operand top = whole(formula_);
    if (share(top) == Share::kNone) return Formula{Token::make(TokenKind::kOr, 1)};
    tasks_.push_back({Task::kOwn, top});
    while (!tasks_.empty()) {
      if (out_.size() > most_tokens)
        return Error{ErrorKind::kMachine, "colours are nested too deeply to be measured apart"};
      const auto [task, operand] = tasks_.back();
      tasks_.pop_back();
      switch (task) {
        case Task::kOwn:
          own(operand);
          break;
        case Task::kCopy:
          out_.copy(operand, false);
          break;
        case Task::kNegate:
          out_.copy(operand, true);
          break;
        case Task::kOpenAnd:
          out_.open(TokenKind::kAnd);
          break;
        case Task::kOpenOr:
          out_.open(TokenKind::kOr);
          break;
        case Task::kClose:
          out_.close();
          break;
      }
    }
    return out_.take();
  }

 private:
  enum class Task : uint8_t { kOwn, kCopy, kNegate, kOpenAnd, kOpenOr, kClose };
  using Step = std::pair<Task, Operand>;

  Share share(Operand operand) const { return shares_[operand.index]; }

  /// From the last token to the first, so that operands come before their groups.
  void find_shares(const Scene& scene, const std::function<bool(uint32_t)>& is_wanted) {
    for (size_t i = formula_.size(); i-- > 0;) {
      const Token token = formula_[i];
      if (token.is_pass()) continue;
      if (!token.is_group()) {
        const uint32_t unit =
            token.kind() == TokenKind::kUnit ? token.payload() : scene.faces[token.payload()].unit;
        shares_[i] = is_wanted(scene.units[unit].id) ? Share::kAll : Share::kNone;
        continue;
      }
      Share all = Share::kNone;
      bool is_first = true;
      for (const Operand operand : operands_of(operand_at(formula_, i))) {
        const Share its = share(operand);
        if (is_first)
          all = its;
        else if (token.kind() == TokenKind::kOr && its != all)
          all = Share::kSome;
        is_first = false;
      }
      shares_[i] = all;
    }
  }

  void own(Operand operand) {
    if (share(operand) == Share::kAll) return out_.copy(operand, false);
    std::vector<Step> steps;
    if (operand.token().kind() == TokenKind::kAnd)
      own_of_first(operand, steps);
    else
      own_of_any(operand, steps);
    tasks_.insert(tasks_.end(), steps.rbegin(), steps.rend());
  }

  static void own_of_first(Operand group, std::vector<Step>& steps) {
    steps.push_back({Task::kOpenAnd, {}});
    Task task = Task::kOwn;
    for (const Operand operand : operands_of(group)) {
      steps.push_back({task, operand});
      task = Task::kCopy;
    }
    steps.push_back({Task::kClose, {}});
  }

  /// What one operand holds, the ones behind it do not have.
  void own_of_any(Operand group, std::vector<Step>& steps) const {
    std::vector<Operand> operands;
    for (const Operand operand : operands_of(group)) operands.push_back(operand);
    while (share(operands.back()) == Share::kNone) operands.pop_back();
    size_t open = 0;
    const auto enter = [&](Task group_task) {
      steps.push_back({group_task, {}});
      ++open;
    };
    for (size_t i = 0; i < operands.size(); ++i) {
      const Share its = share(operands[i]);
      const bool is_last = i + 1 == operands.size();
      if (its != Share::kNone) {
        if (!is_last) enter(Task::kOpenOr);
        steps.push_back({its == Share::kAll ? Task::kCopy : Task::kOwn, operands[i]});
      }
      if (its != Share::kAll && !is_last) {
        enter(Task::kOpenAnd);
        steps.push_back({Task::kNegate, operands[i]});
      }
    }
    for (; open > 0; --open) steps.push_back({Task::kClose, {}});
  }

  std::span<const Token> formula_;
  std::vector<Share> shares_;  ///< by token; of passes nothing
  std::vector<Step> tasks_;
  FormulaWriter out_;
};

}  // namespace

Result<Formula> material_of(const Scene& scene, const std::function<bool(uint32_t id)>& is_wanted,
                            size_t most_tokens) {
  return MaterialWriter(scene, is_wanted).write(most_tokens);
}

}  // namespace whittle
