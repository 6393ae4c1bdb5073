#include "app/record/recording.h"

#include <zlib.h>

#include <algorithm>

namespace twinarm {
namespace {

// Of items that take so many bytes at least: a file cannot ask for more of them than it can hold.
template <class T, class F>
void visit_all(Memory& memory, std::vector<T>& items, std::size_t least, F f) {
  memory.resize(items, least);
  for (T& item : items) f(item);
}
constexpr std::size_t kLeastText = 8, kVector = 24, kLeastContact = 16 + 4 * kVector;  // [bytes]

void visit_path(Memory& memory, std::filesystem::path& path) {
  std::string text = path.string();
  memory.visit(text);
  path = text;
}

void visit_number(Memory& memory, std::optional<double>& number) {
  bool given = number.has_value();
  double value = number.value_or(0);
  memory.visit(given);
  memory.visit(value);
  if (given)
    number = value;
  else
    number.reset();
}

void visit_run(Memory& memory, RecordedRun& run) {
  visit_path(memory, run.model);
  visit_path(memory, run.state);
  memory.visit(run.gravity);
  for (bool* flag : {&run.floating, &run.friction, &run.armature, &run.strict}) memory.visit(*flag);
  for (auto* number : {&run.duration, &run.step, &run.tolerance, &run.energy_bound})
    visit_number(memory, *number);
  memory.visit(run.integrator);
  memory.visit(run.contact);
}

}  // namespace

std::string name_of_pair(const std::vector<std::string>& geometries, int a, int b) {
  const auto name = [&](int id) {
    const auto i = static_cast<std::size_t>(id);
    return i < geometries.size() ? geometries[i] : std::to_string(id);
  };
  return name(a) + "-" + name(b);
}

std::vector<double> works_by_row(const RecordedFrame& frame, std::size_t rows) {
  std::vector<double> works(rows, 0);
  for (std::size_t i = 0; i < std::min(frame.rows.size(), frame.works.size()); ++i)
    if (frame.rows[i] < rows) works[frame.rows[i]] = frame.works[i];
  return works;
}

std::vector<double> momenta_by_row(const RecordedFrame& frame, std::size_t rows) {
  std::vector<double> momenta(6 * rows, 0);
  for (std::size_t i = 0; i < frame.momentum_rows.size(); ++i)
    for (std::size_t c = 0; c < 6; ++c)
      momenta.at(6 * frame.momentum_rows[i] + c) =
          frame.momenta.at(2 * i + c / 3)[static_cast<Eigen::Index>(c % 3)];
  return momenta;
}

std::uint64_t hash_of(const std::string& bytes) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return hash;
}

std::uint32_t checksum(const char* bytes, std::size_t count) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const unsigned char*>(bytes), count));
}

void visit_version_2(Memory& memory, RecordingHeader& header) {
  memory.visit(header.program);
  visit_all(memory, header.command, kLeastText, [&](std::string& word) { memory.visit(word); });
  visit_all(memory, header.files, 2 * kLeastText, [&](RecordedFile& file) {
    memory.visit(file.path);
    memory.visit(file.bytes);
  });
  visit_run(memory, header.run);
  memory.visit(header.integrator);
  memory.visit(header.step);
  memory.visit(header.duration);
  memory.visit(header.seed);
  visit_all(memory, header.columns, 2 * kLeastText, [&](RecordedColumn& column) {
    memory.visit(column.name);
    memory.visit(column.unit);
  });
  visit_all(memory, header.couplings, kLeastText, [&](std::string& name) { memory.visit(name); });
  visit_all(memory, header.geometries, kLeastText, [&](std::string& name) { memory.visit(name); });
}

void visit(Memory& memory, RecordedFrame& frame) {
  memory.visit(frame.step);
  memory.visit(frame.t);
  memory.visit(frame.hash);
  memory.visit(frame.values);
  visit_all(memory, frame.pulls, kVector, [&](Vector3& pull) { memory.visit(pull); });
  visit_all(memory, frame.contacts, kLeastContact, [&](RecordedContact& contact) {
    memory.visit(contact.a);
    memory.visit(contact.b);
    memory.visit(contact.depth);
    for (Vector3* v : {&contact.point, &contact.normal, &contact.force, &contact.couple})
      memory.visit(*v);
  });
  memory.visit(frame.rows);
  memory.visit(frame.works);
  memory.visit(frame.momentum_rows);
  visit_all(memory, frame.momenta, kVector, [&](Vector3& momentum) { memory.visit(momentum); });
  memory.visit(frame.memory);
}

}  // namespace twinarm
