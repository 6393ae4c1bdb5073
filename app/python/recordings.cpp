// A recording as arrays: attributes of a Recording (twinarm/_recording.py).
#include <pybind11/stl.h>

#include "app/python/arrays.h"
#include "app/python/signals.h"
#include "app/record/recording_reader.h"

namespace twinarm::python {
namespace {

using namespace py::literals;

// Tables have a row for each frame. Rows of the energy balance are zero before they appear.
py::dict open_recording(const py::object& file) {
  const Recording recording(path_of(file));
  const RecordingHeader& header = recording.header();
  const auto frames = static_cast<py::ssize_t>(recording.size());
  const auto size = [](const auto& list) { return static_cast<py::ssize_t>(list.size()); };
  Array t = zeros({frames}), values = zeros({frames, size(header.columns)}),
        works = zeros({frames, size(recording.rows())}),
        pulls = zeros({frames, size(header.couplings), 3});
  py::array_t<long> step(frames);
  for (py::ssize_t n = 0; n < frames; ++n) {
    check_signals();
    const RecordedFrame frame = recording.frame(static_cast<std::size_t>(n));
    *t.mutable_data(n) = frame.t;
    *step.mutable_data(n) = frame.step;
    std::copy(frame.values.begin(), frame.values.end(),
              values.mutable_data() + n * values.shape(1));
    for (std::size_t i = 0; i < frame.rows.size(); ++i)
      *works.mutable_data(n, frame.rows[i]) = frame.works[i];
    for (std::size_t c = 0; c < frame.coupling_forces.size(); ++c)
      store(frame.coupling_forces[c], pulls.mutable_data(n, static_cast<py::ssize_t>(c), 0));
  }
  return py::dict("t"_a = t, "step"_a = step, "values"_a = values, "works"_a = works,
                  "forces"_a = pulls, "units"_a = units_of(header.columns),
                  "rows"_a = recording.rows(), "couplings"_a = header.couplings,
                  "integrator"_a = header.integrator, "h"_a = header.step,
                  "command"_a = header.command, "alarms"_a = recording.alarms(),
                  "notes"_a = recording.notes(), "end"_a = recording.end());
}

}  // namespace

void add_recordings(py::module_& m) {
  m.def("_open_recording", open_recording);
}

}  // namespace twinarm::python
