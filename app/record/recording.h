// Contents of a recording (docs/reference/recording_file.md): header and frames.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <unordered_map>

#include "app/record/frame_coder.h"
#include "app/run/run.h"
#include "solver/spatial/pose.h"
#include "solver/support/atomic_file.h"
#include "solver/support/state_archive.h"

namespace twinarm {

// A copy of a file that the run read.
struct RecordedFile {
  std::string path, bytes;  // absolute path
};

struct RecordingHeader {
  std::string program;  // its version
  std::vector<std::string> command;
  std::vector<RecordedFile> files;  // the model or scene first
  RunSettings run;                  // as given, with absolute paths
  std::string integrator;
  double step = 0, duration = 0;   // [s]
  long seed = 0;                   // runs have no randomness
  std::vector<RunColumn> columns;  // of RecordedFrame::values; without kinds if read
  std::vector<std::string> couplings;
  std::vector<std::string> geometries;  // indexed by RecordedContact
};

struct RecordedContact {  // on b, world axes
  int a = 0, b = 0;
  double depth = 0;  // [m]
  Vector3 point = Vector3::Zero(), normal = Vector3::Zero();
  Vector3 force = Vector3::Zero(), couple = Vector3::Zero();  // [N], [N m]
};

struct RecordedFrame {
  long step = 0;
  double t = 0;                          // [s]
  std::uint64_t hash = 0;                // of memory, as recorded before version 4
  std::vector<double> q, qd;             // of the model, with prescribed joints; empty: in memory
  std::vector<double> values;            // coordinates, velocities, positions, energies
  std::vector<Vector3> coupling_forces;  // coupling forces on the link [N or N m]
  std::vector<RecordedContact> contacts;
  std::vector<std::uint32_t> rows;           // of the energy balance: indices of names
  std::vector<double> works;                 // [J]
  std::vector<std::uint32_t> momentum_rows;  // of the momentum balance: indices of names
  std::vector<Vector3> momenta;              // linear, angular of each row [N s], [N m s]
  std::string memory;  // serialized state of the run; of a recording only in keyframes
};
// Fills in q and qd from memory, if it is there. Throws std::runtime_error.
void take_state_from_memory(RecordedFrame& frame);

// "A-B" of a contact.
std::string name_of_pair(const std::vector<std::string>& geometries, int a, int b);
// Values by row, zero for rows that the frame does not have; six numbers for each row of momentum.
std::vector<double> works_by_row(const RecordedFrame& frame, std::size_t rows);
std::vector<double> momenta_by_row(const RecordedFrame& frame, std::size_t rows);

// FNV-1a, 64 bits; `basis`: its offset basis.
std::uint64_t hash_of(const std::string& bytes, std::uint64_t basis = 0xcbf29ce484222325u);
// Hash of a state in a recording of this version: of t, q and qd; before version 4 the recorded
// one.
std::uint64_t hash_of(const RecordedFrame& frame, std::uint32_t version);

// The header as JSON, with the layout of frames; the contents of files follow in their own blocks.
// Parsing ignores unknown keys and throws std::runtime_error if a key is missing or invalid, or
// frames have another layout.
std::string header_text(const RecordingHeader& header);
RecordingHeader parse_header(std::string_view text, std::uint32_t version);
// Serialize (solver/support/state_archive.h): the header of format version 2, a frame of version 3,
// a frame without memory, its part that does not depend on the numbers of rows.
void visit_version_2(StateArchive& memory, RecordingHeader& header);
void visit_version_3(StateArchive& memory, RecordedFrame& frame);
void visit(StateArchive& memory, RecordedFrame& frame);
void visit_motion(StateArchive& memory, RecordedFrame& frame);

// Blocks of the file: kind, length, payload, CRC-32 of all three. Little-endian.
namespace recording_format {
inline constexpr char kMagic[9] = "TWINREC\n";
inline constexpr std::uint32_t kVersion = 4;  // versions 2 and 3 can be read
inline constexpr char kHeader = 'H', kFile = 'D', kName = 'N', kMomentumName = 'M', kAlarm = 'A',
                      kMemory = 'S', kFrame = 'F', kEnd = 'E';
inline constexpr long kKeyframeEvery = 64;             // steps
inline constexpr std::size_t kFrameStart = 16;         // bytes of step and time, not compressed
inline constexpr std::size_t kStart = 12;              // magic and version
inline constexpr std::size_t kBefore = 5, kAfter = 4;  // bytes of a block around its payload
}  // namespace recording_format
std::uint32_t checksum(const char* bytes, std::size_t count);

// Writes a recording during a run: into FILE.part, renamed to FILE at the end. Data are flushed
// every 0.25 s at the latest, and readers accept a .part: a crash loses no more.
// A run that ends before its first frame leaves none, and no recording of before is replaced.
class RecordingWriter {
 public:
  // Throws InputError if the file cannot be written. keyframe_every [steps]: 1 where forces or
  // targets from outside the scene act, so that no step can be repeated from an earlier one.
  RecordingWriter(const std::filesystem::path& file, RecordingHeader header,
                  long keyframe_every = recording_format::kKeyframeEvery);
  // Index of a row of the energy or momentum balance (`kind`: kName or kMomentumName of
  // recording_format); writes new names.
  std::uint32_t number_of(char kind, const std::string& row);
  void alarm(const std::string& words) { block(recording_format::kAlarm, words); }
  // Whether the frame of this step becomes a keyframe, and so needs its memory.
  bool needs_memory(long step) const { return !keyframe_ || step - *keyframe_ >= keyframe_every_; }
  void write(RecordedFrame& frame);
  // Writes how the run ended and renames the file, if it has a frame. Throws InputError.
  void finish(const std::string& how);

 private:
  void block(char kind, std::string_view start, std::string_view rest = {});  // payload: both
  void flush();

  UnfinishedFile out_;
  std::string waiting_;
  std::chrono::steady_clock::time_point flushed_;
  struct Names {
    std::unordered_map<std::string, std::uint32_t> numbers;
    std::vector<std::string> names;    // by number
    std::vector<std::uint32_t> after;  // number of the row that came next, by number
    std::uint32_t last = 0;
  };
  std::map<char, Names> names_;  // by kind
  FrameCoder coder_;
  std::size_t frame_bytes_ = 0;  // of the last one
  long keyframe_every_;
  std::optional<long> keyframe_;  // step of the last one
};

std::filesystem::path part_of(const std::filesystem::path& file);

}  // namespace twinarm
