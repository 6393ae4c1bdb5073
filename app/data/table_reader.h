// Reads a table of a scene or state file key by key. Invalid values add a diagnostic and return
// nothing, so that all errors are reported. done() reports keys that were not read as unknown.
#pragma once

#include <optional>
#include <span>

#include "app/data/value.h"
#include "solver/spatial/pose.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

class TableReader {
 public:
  // Keeps references to its arguments. `where`: the table in diagnostics, "body 'ball'".
  TableReader(const Value& table, std::string where, const std::string& file,
              DiagnosticList& faults)
      : table_(table), where_(std::move(where)), file_(file), faults_(faults) {}
  // A JSON object: diagnostics name `where`, or BEFORE KEY AFTER: "wrenches[0].link",
  // "q of joint 'elbow'".
  struct Place {
    std::string where, before, after;
  };
  TableReader(const Value& object, Place place, const std::string& file, DiagnosticList& faults)
      : table_(object),
        where_(place.where),
        place_(std::move(place)),
        file_(file),
        faults_(faults) {}

  const Value* find(const std::string& key);  // nullptr if not given
  bool has(const std::string& key) { return find(key) != nullptr; }
  int line() const { return table_.line; }
  const std::string& where() const { return where_; }
  void rename(std::string where) { where_ = std::move(where); }

  std::optional<double> number(const std::string& key);        // finite
  std::optional<double> positive(const std::string& key);      // > 0
  std::optional<double> not_negative(const std::string& key);  // >= 0
  std::optional<std::string> text(const std::string& key);     // not empty
  std::optional<bool> flag(const std::string& key);
  std::optional<std::vector<double>> numbers(const std::string& key, std::size_t count);
  std::optional<Vector3> vector(const std::string& key);
  std::optional<Vector3> unit_vector(const std::string& key);
  std::optional<Matrix3> orientation(const std::string& key);  // of a unit quaternion w, x, y, z
  // Length of a quaternion if it is 1 to 1e-6, or a diagnostic.
  std::optional<double> unit_length(const std::string& key, std::span<const double, 4> q);
  // Index of the name in `names`.
  std::optional<std::size_t> choice(const std::string& key, const std::vector<std::string>& names);
  std::vector<const Value*> tables(const std::string& key);
  const Value* table(const std::string& key) {
    return find(key, Value::Kind::table, place_ ? "an object" : "a table");
  }

  const Value& value() const { return table_; }
  const std::string& file() const { return file_; }
  std::string where(const std::string& key) const;

  // At the line of the key if it is given, else of the table.
  void fault(const std::string& key, std::string problem, std::string fix, std::string_view code);
  void missing(const std::string& key, std::string fix) {
    if (!find(key)) fault(key, "is missing", std::move(fix), "scene.missing");
  }
  bool is_full() const { return faults_.is_full(); }  // more diagnostics are dropped
  void done();

 private:
  const Value* find(const std::string& key, Value::Kind kind, const char* wanted);

  const Value& table_;
  std::string where_;
  std::optional<Place> place_;
  const std::string& file_;
  DiagnosticList& faults_;
  std::vector<std::string> known_;  // keys read
};

}  // namespace twinarm
