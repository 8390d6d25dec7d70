// The arguments of a statement as numbers, vectors, texts and answers to yes or no.
//
// An argument of a wrong type leaves the default, with a warning; undef is as good as nothing.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "base/vec.h"
#include "csg/statements.h"
#include "csg/values.h"
#include "model/warnings.h"

namespace whittle {

/// Warns of `problem`, with the statement's name before it.
void warn(const Statement& statement, std::string_view problem, Warnings& warnings);

/// The argument of a parameter; null if it is not given.
inline const Value* argument(const Statement& statement, size_t index) {
  return statement.arguments[index];
}

/// The same; undef is not given.
inline const Value* defined_argument(const Statement& statement, size_t index) {
  const Value* const value = argument(statement, index);
  return value && value->kind != Value::Kind::kUndef ? value : nullptr;
}

inline bool is_number(const Value* value) {
  return value && value->kind == Value::Kind::kNumber;
}
inline bool is_vector(const Value* value) {
  return value && value->kind == Value::Kind::kVector;
}

/// Up to `capacity` numbers of a vector; how many there are, or -1 if it holds anything else.
int numbers(const Value* value, double* out, int capacity);

/// A vector of exactly so many numbers.
std::optional<Vec3> as_vec3(const Value& value);
std::optional<Vec2> as_vec2(const Value& value);

/// Three numbers, or two and then `z`.
std::optional<Vec3> vec3_or_vec2(const Value* value, double z);

std::optional<double> read_number(const Statement& statement, size_t index, Warnings& warnings);
void read_bool(const Statement& statement, size_t index, bool& answer, Warnings& warnings);

/// A string with its escapes resolved.
std::optional<std::string> read_string(const Statement& statement, size_t index,
                                       Warnings& warnings);

/// The radius by radius or diameter; the diameter wins.
std::optional<double> radius(const Statement& statement, size_t radius_index, size_t diameter_index,
                             Warnings& warnings);

/// Warns that a shape is empty because one of its sizes is not finite: OpenSCAD would read such a
/// name as undef.
void warn_if_not_finite(const Statement& statement, std::initializer_list<double> sizes,
                        Warnings& warnings);

/// What a string means that stands so between quotes: \" \\ \n \t \r, \x and two digits, \u and
/// four, \U and six. Other backslashes stay.
std::string unescaped(std::string_view raw);

}  // namespace whittle
