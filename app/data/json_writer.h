// Writes one JSON object as text, key by key, in the order in which it is told.
//
// Numbers have the fewest digits (17 at most) that read back as the same double, and a point or an
// exponent, so that readers take them for floating-point numbers; what is not finite is null.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace twinarm {

class JsonWriter {
 public:
  JsonWriter& key(std::string_view name);
  void begin_object() { open('{'); }
  void end_object() { close('}'); }
  void begin_array() { open('['); }
  void end_array() { close(']'); }

  void number(double value);
  void count(long value);
  void text(std::string_view value);
  void boolean(bool value) { write(value ? "true" : "false"); }
  void null() { write("null"); }

  // A matrix is a list of its rows, a vector a list of numbers.
  template <class Derived>
  void matrix(const Eigen::MatrixBase<Derived>& values) {
    begin_array();
    for (Eigen::Index i = 0; i < values.rows(); ++i) vector(values.row(i));
    end_array();
  }
  template <class Derived>
  void vector(const Eigen::MatrixBase<Derived>& values) {
    begin_array();
    for (Eigen::Index i = 0; i < values.size(); ++i) number(values(i));
    end_array();
  }
  void numbers(const std::vector<double>& values);
  void texts(const std::vector<std::string>& values);
  // As the command line has joint values: a number where there is one, else a list.
  void number_or_list(const std::vector<double>& values);

  const std::string& str() const { return text_; }

 private:
  void open(char bracket);
  void close(char bracket);
  void separate();  // the comma before an item that is not the first
  void write(std::string_view item);

  std::string text_;
  int depth_ = 0;
  bool first_ = true;  // nothing stands between the last opening bracket and here
  bool keyed_ = false;
};

}  // namespace twinarm
