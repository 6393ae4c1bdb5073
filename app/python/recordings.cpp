// A recording as arrays.
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>

#include "app/python/arrays.h"
#include "app/record/recording_reader.h"
#include "app/support/text.h"

namespace twinarm::python {
namespace {

// One row per frame; rows of the balance are zero before they appear.
struct Opened {
  Recording recording;
  std::vector<double> t;
  std::vector<long> step;
  std::vector<double> values;  // frames x columns
  std::vector<double> works;   // frames x rows of the energy_balance
  std::vector<double> pulls;   // frames x couplings x 3

  explicit Opened(const std::filesystem::path& file) : recording(file) {
    const RecordingHeader& header = recording.header();
    const std::size_t rows = recording.rows().size(), couplings = header.couplings.size();
    for (std::size_t n = 0; n < recording.size(); ++n) {
      if (n % 1024 == 1023 && PyErr_CheckSignals() != 0) throw py::error_already_set();
      const RecordedFrame frame = recording.frame(n);
      t.push_back(frame.t);
      step.push_back(frame.step);
      values.insert(values.end(), frame.values.begin(), frame.values.end());
      works.resize(works.size() + rows);
      for (std::size_t i = 0; i < frame.rows.size(); ++i)
        works[n * rows + frame.rows[i]] = frame.works[i];
      pulls.resize(pulls.size() + 3 * couplings);
      for (std::size_t c = 0; c < frame.pulls.size(); ++c)
        store(frame.pulls[c], &pulls[3 * (n * couplings + c)]);
    }
  }
  std::size_t frames() const { return t.size(); }
  std::size_t columns() const { return recording.header().columns.size(); }
};

// One column of a table.
Array column(const std::vector<double>& table, std::size_t frames, std::size_t columns,
             std::size_t first) {
  Array one = zeros({static_cast<py::ssize_t>(frames)});
  for (std::size_t n = 0; n < frames; ++n)
    *one.mutable_data(static_cast<py::ssize_t>(n)) = table[n * columns + first];
  return one;
}

std::vector<std::string> channel_names(const Opened& opened) {
  std::vector<std::string> names;
  for (const RecordedColumn& one : opened.recording.header().columns) names.push_back(one.name);
  return names;
}

Array channel(const Opened& opened, const std::string& name) {
  const std::vector<std::string> names = channel_names(opened);
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw py::key_error("there is no channel '" + name + "'; " +
                        name_remedy(name, names, "channels"));
  return column(opened.values, opened.frames(), opened.columns(),
                static_cast<std::size_t>(found - names.begin()));
}

// The columns whose names begin with `with`; they are adjacent.
Array beginning(const Opened& opened, const std::string& with) {
  const std::vector<std::string> names = channel_names(opened);
  const auto fits = [&](const std::string& name) { return name.starts_with(with); };
  const auto first = static_cast<std::size_t>(std::ranges::find_if(names, fits) - names.begin());
  const auto count = static_cast<std::size_t>(std::ranges::count_if(names, fits));
  Array all = zeros({static_cast<py::ssize_t>(opened.frames()), static_cast<py::ssize_t>(count)});
  for (std::size_t n = 0; n < opened.frames(); ++n)
    std::copy_n(opened.values.begin() + static_cast<std::ptrdiff_t>(n * opened.columns() + first),
                count, all.mutable_data() + n * count);
  return all;
}

py::dict units(const Opened& opened) {
  py::dict all;
  for (const RecordedColumn& one : opened.recording.header().columns)
    all[py::str(one.name)] = one.unit;
  return all;
}

py::dict energy_balance(const Opened& opened) {
  py::dict all;
  const std::vector<std::string>& rows = opened.recording.rows();
  for (std::size_t r = 0; r < rows.size(); ++r)
    all[py::str(rows[r])] = column(opened.works, opened.frames(), rows.size(), r);
  return all;
}

py::dict pulls(const Opened& opened) {
  py::dict all;
  const std::vector<std::string>& names = opened.recording.header().couplings;
  for (std::size_t c = 0; c < names.size(); ++c) {
    Array one = zeros({static_cast<py::ssize_t>(opened.frames()), 3});
    for (std::size_t n = 0; n < opened.frames(); ++n)
      std::copy_n(&opened.pulls[3 * (n * names.size() + c)], 3, one.mutable_data() + 3 * n);
    all[py::str(names[c])] = one;
  }
  return all;
}

}  // namespace

void add_recordings(py::module_& m) {
  py::class_<Opened> recording(
      m, "Recording", "A recording as arrays: N frames in rows (docs/use/record_and_resume.md).");
  recording.def_property_readonly(
      "t", [](const Opened& o) { return array_of(o.t); }, "(N,) times of the frames [s]");
  recording.def_property_readonly(
      "step",
      [](const Opened& o) {
        return py::array_t<long>(static_cast<py::ssize_t>(o.step.size()), o.step.data());
      },
      "(N,) numbers of the steps (integers)");
  recording.def_property_readonly(
      "q", [](const Opened& o) { return beginning(o, "q/"); },
      "(N, columns 'q/..') coordinates [rad, m], without mimic joints");
  recording.def_property_readonly(
      "qd", [](const Opened& o) { return beginning(o, "qd/"); },
      "(N, columns 'qd/..') velocities [rad/s, m/s]");
  recording.def("keys", channel_names, "names of the channels, in their order");
  recording.def("__getitem__", channel, py::arg("name"),
                "(N,): one channel, such as rec['q/j1'] or rec['kinetic_energy']; its unit is in\n"
                "units. Raises KeyError for another name.");
  recording.def_property_readonly("units", units, "{channel: unit}");
  recording.def_property_readonly("energy_balance", energy_balance,
                                  "{row: (N,) work since the start [J]}; 0 before a row appears");
  recording.def_property_readonly(
      "pulls", pulls, "{coupling: (N, 3)}: coupling force on the link, world axes [N or N m]");
  const auto header = [&](const char* name, auto member, const char* doc) {
    recording.def_property_readonly(
        name, [member](const Opened& o) { return o.recording.header().*member; }, doc);
  };
  header("integrator", &RecordingHeader::integrator, "its name");
  header("h", &RecordingHeader::step, "the step [s]");
  header("command", &RecordingHeader::command, "the command that made it, as a list of words");
  recording.def_property_readonly(
      "alarms", [](const Opened& o) { return o.recording.alarms(); },
      "alarms of the energy balance");
  recording.def_property_readonly(
      "notes", [](const Opened& o) { return o.recording.notes(); }, "missing or damaged parts");
  recording.def_property_readonly(
      "end", [](const Opened& o) { return o.recording.end(); }, "how the run ended; '' if unknown");
  m.def(
      "open_recording",
      [](const py::object& file) { return std::make_unique<Opened>(path_of(file)); },
      py::arg("file"),
      "Opens a recording of `twinarm simulate --record FILE`, or its valid part. Raises "
      "InputError\n"
      "for other files.");
}

}  // namespace twinarm::python
