// A job folder: what a render is cut into, and which of its pieces are there. Knows files and films, nothing of engines, devices or
// how a piece is rendered.
#pragma once
#include <string>
#include <vector>

#include "image/film_file.h"

namespace stokes {

/// Samples [begin, end) of every pixel, in one film file of the folder.
struct JobPart {
  int begin = 0, end = 0;
  std::string file;  ///< with the folder
};

/// The manifest, `job.json`. Two jobs are the same render when their `wanted` agree; their parts agree only if they were cut alike.
struct Job {
  std::string folder;
  std::string scene;                 ///< absolute
  std::vector<std::string> options;  ///< of `stokes render`, without the scene, --samples, --threads and -o
  FilmRecord wanted;                 ///< what every part must match; without words. A part of any device will do where it names none
  std::string output;                ///< of the merged image, absolute
  std::vector<std::string> merge_options;
  std::vector<JobPart> parts;  ///< in the order of their samples
};

enum class PartState { Done, Missing, Unfinished, Damaged, Foreign };

struct PartReport {
  PartState state = PartState::Missing;
  std::string reason;  ///< one phrase, empty when done
};

/// "done", "missing", "unfinished", "damaged", "foreign".
const char* part_state_name(PartState state);

/// Cuts `samples` into `count` ranges that differ by one sample at most (fewer where there are fewer samples), named in `folder`.
std::vector<JobPart> cut_samples(int samples, int count, const std::string& folder);

/// The manifest's name in a folder.
std::string manifest_path(const std::string& folder);

/// Throws OutputError.
void write_job(const Job& job);

/// Throws InputError: no manifest, damaged, of another version of the format.
Job read_job(const std::string& folder);

/// Why the folder's job is not the one that is asked for: one phrase, or empty.
std::string job_mismatch(const Job& found, const Job& asked);

/// Reads the part's file as a whole, its checksum too.
PartReport examine_part(const Job& job, const JobPart& part);

/// True when the part has a checkpoint that its render may continue.
bool checkpoint_fits(const Job& job, const JobPart& part);

/// The arguments of the `stokes` that renders the part: what a unit of work is. Looks at the part's checkpoint.
std::vector<std::string> part_arguments(const Job& job, const JobPart& part);

/// The arguments of the `stokes` that merges the parts.
std::vector<std::string> merge_arguments(const Job& job, const std::string& output);

/// Words as a line that a POSIX shell splits into the same words.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace stokes
