// Which edits a faulty face is offered, and in what order.
#include "mesh/shell_repair.h"

#include <deque>
#include <random>
#include <set>

#include "mesh/shell_edit.h"

namespace stokes {
namespace {

constexpr int kRounds = 60;
constexpr int kLate = 5;                  // from this round on bolder means are used, and others more rarely
constexpr double kHopeless = 0.5;         // a shell with this share of faulty faces is better made anew
constexpr double kWork = 200;             // faces that edits may be weighed by, for each that the shell has, before it is left as it is
constexpr double kLeast = 1e6;            // of these, for small shells
constexpr double kEnough = 0.5;           // an edit that leaves less than this share of the faults is taken at once
constexpr double kGain = 0.05;            // the least gain an edit must bring, and the least share of the faults
constexpr double kShortest = 0.02;        // of the distance: edges are not divided below,
constexpr double kShortestRefined = 0.25; // nor below this where that brings nothing yet
constexpr double kBold = 30;              // what dividing a face that nothing helps may cost at first

// The place next to `start` that is on all the planes, as far as they have one: least squares, held to the start where they leave it free.
Vec3d meet(const std::vector<ShellMeasure::Corner>& planes, Vec3d start) {
  constexpr double kHold = 1e-3;
  Vec3d x{kHold, 0, 0}, y{0, kHold, 0}, z{0, 0, kHold}, b;
  for (const auto& [at, n] : planes) {
    x += n * n.x, y += n * n.y, z += n * n.z;
    b += n * dot(n, at - start);
  }
  return start + Vec3d{dot(b, cross(y, z)), dot(x, cross(b, z)), dot(x, cross(y, b))} / dot(x, cross(y, z));
}

class Repair {
 public:
  Repair(const MeshData& shell, const ShellMeasure& measure) : editor_(shell, measure), measure_(measure), work_(std::max(kWork * static_cast<double>(editor_.faces()), kLeast)) {}

  bool changed() const { return made_ > 0; }
  MeshData mesh() const { return editor_.mesh(); }
  ShellFaults faults() const { return editor_.faults(); }

  void run() {
    std::size_t fewest = editor_.faces();
    int since = 0;
    for (int round = 0; round < kRounds; round++) {
      const std::vector<std::uint32_t> faulty = faulty_faces();
      if (faulty.empty() || static_cast<double>(faulty.size()) > kHopeless * static_cast<double>(editor_.faces())) return;
      // An end where two times through all the means have brought nothing.
      since = faulty.size() < fewest ? 0 : since + 1;
      fewest = std::min(fewest, faulty.size());
      if (since > 2 * kLate || work_ <= 0) break;
      sweep(faulty, round);
    }
    faulty_faces();
  }

 private:
  std::vector<std::uint32_t> faulty_faces() {
    std::vector<std::uint32_t> found;
    for (std::uint32_t f = 0; f < editor_.faces(); f++) {
      if (!editor_.faulty(f)) continue;
      editor_.refresh(f);
      if (editor_.faulty(f)) found.push_back(f);
    }
    return found;
  }

  void sweep(const std::vector<std::uint32_t>& faulty, int round) {
    std::deque<std::uint32_t> queue(faulty.begin(), faulty.end());
    std::vector<char> waiting(editor_.faces());
    for (const std::uint32_t f : faulty) waiting[f] = 1;
    std::size_t left = 4 * faulty.size() + 200;
    refilled_.clear();
    while (!queue.empty() && left-- > 0 && work_ > 0) {
      const std::uint32_t f = queue.front();
      queue.pop_front();
      waiting[f] = 0;
      if (!editor_.faulty(f)) continue;
      editor_.refresh(f);
      if (!editor_.faulty(f) || !mend(f, round)) continue;
      waiting.resize(editor_.faces());
      for (const std::uint32_t g : touched_)
        if (editor_.faulty(g) && !waiting[g]) waiting[g] = 1, queue.push_back(g);
    }
  }

  // Keeps the best edit so far; true when it is good enough to look no further.
  bool offer(ShellEdit&& edit) {
    if (!edit.possible()) return false;
    const double before = editor_.cost_before(edit), gain = best_gain_ < 0 ? best_gain_ : std::max(best_gain_, kGain * before);
    work_ -= static_cast<double>(edit.added.size());
    const double after = editor_.cost_after(edit, before - gain);
    if (!(before - after > gain)) return false;
    best_gain_ = before - after;
    enough_ = after < kEnough * before;
    best_ = std::move(edit);
    return enough_;
  }

  bool mend(std::uint32_t f, int round) {
    best_gain_ = kGain, best_ = {}, enough_ = false;
    const auto t = editor_.triangle(f);
    // Refined places are left to themselves for some rounds: what is undone at once leads round in circles.
    const bool coarsen = round < kLate || round % kLate == 0;
    if (!(turn(t) || divide(t) || place(t, round) || (coarsen && collapse(t))) && !best_.possible() && coarsen && round > 0) refill(f, round);
    if (!best_.possible()) {
      if (round > 0) refine(t, round);
      return false;
    }
    touched_ = best_.removed;
    for (std::size_t i = editor_.faces(); i < editor_.faces() + best_.added.size(); i++) touched_.push_back(static_cast<std::uint32_t>(i));
    editor_.apply(best_);
    made_++;
    while (!touched_.empty() && touched_.back() >= editor_.faces()) touched_.pop_back();
    return true;
  }

  bool turn(const ShellEditor::Triangle& t) {
    for (int i = 0; i < 3; i++)
      if (offer(editor_.flip(t[i], t[(i + 1) % 3]))) return true;
    return false;
  }

  bool divide(const ShellEditor::Triangle& t) {
    for (int i = 0; i < 3; i++) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      if (editor_.edge(a, b) < kShortest * std::abs(measure_.d())) continue;
      const Vec3d middle = (editor_.position(a) + editor_.position(b)) * 0.5;
      if (offer(editor_.split(a, b, ridge({a, b}, middle, editor_.edge(a, b)))) || offer(editor_.split(a, b, measure_.project(middle)))) return true;
    }
    return false;
  }

  // A face that nothing helps is too long for the level's bend: its longest side is divided though that brings nothing yet. Its parts
  // have to wait for the next round.
  void refine(const ShellEditor::Triangle& t, int round) {
    int longest = 0;
    for (int i = 1; i < 3; i++)
      if (editor_.edge(t[i], t[(i + 1) % 3]) > editor_.edge(t[longest], t[(longest + 1) % 3])) longest = i;
    const std::uint32_t a = t[longest], b = t[(longest + 1) % 3];
    if (editor_.edge(a, b) < kShortestRefined * std::abs(measure_.d())) return;
    best_gain_ = -kBold * (round < kLate ? 1 : 5);
    const Vec3d middle = (editor_.position(a) + editor_.position(b)) * 0.5;
    offer(editor_.split(a, b, measure_.project(middle)));
    offer(editor_.split(a, b, ridge({a, b}, middle, editor_.edge(a, b))));
    if (!best_.possible()) return;
    editor_.apply(best_);
    made_++;
  }

  bool place(const ShellEditor::Triangle& t, int round) {
    for (const std::uint32_t v : t) {
      Vec3d middle;
      double reach = 0, count = 0;
      std::vector<std::uint32_t> ring;
      for (const std::uint32_t f : editor_.faces_of(v))
        for (const std::uint32_t w : editor_.triangle(f))
          if (w != v) middle += editor_.position(w), count += 1, reach = std::max(reach, editor_.edge(v, w)), ring.push_back(w);
      middle = middle / count;
      const Vec3d old = editor_.position(v);
      if (offer(editor_.move(v, ridge(ring, old, reach))) || offer(editor_.move(v, measure_.project(old))) ||
          offer(editor_.move(v, ridge(ring, middle, reach))) || offer(editor_.move(v, measure_.project((old + middle) * 0.5))) ||
          offer(editor_.move(v, measure_.project(middle))))
        return true;
      std::uniform_real_distribution<double> side(-1, 1);
      for (int i = 0; i < 4 * std::min(round, 4); i++)
        if (offer(editor_.move(v, measure_.project(old + Vec3d{side(random_), side(random_), side(random_)} * (reach * 0.4))))) return true;
    }
    return false;
  }

  bool collapse(const ShellEditor::Triangle& t) {
    for (int i = 0; i < 3; i++) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      const Vec3d p = editor_.position(a), q = editor_.position(b);
      if (!editor_.collapse(a, b, p).possible()) continue;
      if (offer(editor_.collapse(a, b, p)) || offer(editor_.collapse(a, b, q)) || offer(editor_.collapse(a, b, measure_.project((p + q) * 0.5))) ||
          offer(editor_.collapse(a, b, ridge({a, b}, (p + q) * 0.5, length(p - q)))))
        return true;
    }
    return false;
  }

  // Takes away the faulty faces that hang together with this one, and some rings around them, and closes the hole with others.
  bool refill(std::uint32_t f, int round) {
    constexpr std::size_t kMost = 400;
    if (refilled_.contains(f)) return false;  // as part of the same patch
    std::vector<std::uint32_t> faces = {f};
    std::set<std::uint32_t> known = {f};
    const auto grow = [&](std::size_t i, bool any) {
      for (const std::uint32_t v : editor_.triangle(faces[i]))
        for (const std::uint32_t g : editor_.faces_of(v))
          if ((any || editor_.faulty(g)) && known.insert(g).second) faces.push_back(g);
    };
    for (std::size_t i = 0; i < faces.size() && faces.size() < kMost; i++) grow(i, false);
    refilled_.insert(faces.begin(), faces.end());
    for (int ring = 0; ring < 3 && faces.size() < kMost; ring++) {
      if (ring >= round % 3 && offer(editor_.replace(faces))) return true;
      for (std::size_t i = 0, n = faces.size(); i < n; i++) grow(i, true);
    }
    return false;
  }

  // The place near `start` where the level's sides next to the given vertices meet. What lies between them is learned by looking there.
  Vec3d ridge(const std::vector<std::uint32_t>& vertices, Vec3d start, double reach) const {
    std::vector<ShellMeasure::Corner> planes;
    const auto add = [&](Vec3d p, const ShellMeasure::Place& place) { planes.push_back({p + place.gradient * (measure_.d() - place.s), place.gradient}); };
    for (const std::uint32_t v : vertices) planes.push_back({editor_.position(v), editor_.gradient(v)});
    Vec3d p = start;
    for (int i = 0; i < 3; i++) {
      p = meet(planes, start);
      if (length(p - start) > reach) p = start + (p - start) * (reach / length(p - start));
      const ShellMeasure::Place place = measure_.at(p);
      if (place.off < 0.01) break;
      add(p, place);
    }
    return p;
  }

  ShellEditor editor_;
  const ShellMeasure& measure_;
  double work_;  // left to be spent
  ShellEdit best_;
  double best_gain_ = 0;
  std::size_t made_ = 0;  // edits
  bool enough_ = false;
  std::vector<std::uint32_t> touched_;
  std::set<std::uint32_t> refilled_;  // this round
  std::minstd_rand random_{1};  // its own, so that a shell is always the same
};

}  // namespace

ShellFaults repair_shell(MeshData& shell, const MeshDistance& distance, double d) {
  const ShellMeasure measure(distance, d);
  Repair repair(shell, measure);
  repair.run();
  if (repair.changed()) shell = repair.mesh();
  return repair.faults();
}

}  // namespace stokes
