// The fuzz targets without a fuzzer: a folder of seeds, then mutations of them that are the same every time. Knows bytes, not what they mean.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size);

namespace {

using Bytes = std::vector<unsigned char>;

// Words on which readers stumble.
const std::string kWords[] = {"nan", "inf", "-1", "1e999", "0e999", "4294967296", "2147483648", "-2147483649", "1e308", "\"", "{", "[", "\n\n", "\xff\xfe", "\xc2\x9b", "0", "", "#", "/", "//", ","};

std::vector<Bytes> read_seeds(int count, char** folders) {
  std::vector<std::string> paths;
  for (int i = 0; i < count; i++)
    for (const auto& entry : std::filesystem::directory_iterator(folders[i]))
      if (entry.is_regular_file()) paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  std::vector<Bytes> seeds;
  for (const std::string& path : paths) {
    std::ifstream file(path, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return seeds;
}

class Mutator {
 public:
  explicit Mutator(const std::vector<Bytes>& seeds) : seeds_(seeds) {}
  Bytes next() {
    Bytes bytes = seeds_[below(seeds_.size())];
    for (std::size_t i = 0, n = 1 + below(4); i < n; i++) change(bytes);
    return bytes;
  }

 private:
  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }

  void change(Bytes& bytes) {
    const std::size_t at = below(bytes.size() + 1), length = std::min(bytes.size() - at, 1 + below(below(4) == 0 ? 64 : 8));
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at), end = begin + static_cast<std::ptrdiff_t>(length);
    switch (below(7)) {
      case 0: bytes.erase(begin, end); return;
      case 1: { const Bytes copy(begin, end); bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size() + 1)), copy.begin(), copy.end()); return; }
      case 2: bytes.resize(at); return;
      case 3: if (length > 0) *begin = static_cast<unsigned char>(random_()); return;
      case 4: if (length > 0) *begin = static_cast<unsigned char>(*begin ^ (1u << below(8))); return;
      case 5: replace(bytes, at, length, kWords[below(std::size(kWords))]); return;
      default: splice(bytes, at); return;
    }
  }

  static void replace(Bytes& bytes, std::size_t at, std::size_t length, const std::string& word) {
    const auto begin = bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.begin() + static_cast<std::ptrdiff_t>(at + length));
    bytes.insert(begin, word.begin(), word.end());
  }

  // The rest comes from another seed.
  void splice(Bytes& bytes, std::size_t at) {
    const Bytes& other = seeds_[below(seeds_.size())];
    bytes.resize(at);
    bytes.insert(bytes.end(), other.begin() + static_cast<std::ptrdiff_t>(below(other.size())), other.end());
  }

  const std::vector<Bytes>& seeds_;
  std::mt19937_64 random_{1};
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: %s MUTATIONS FOLDER...\n", argv[0]);
    return 64;
  }
  const std::vector<Bytes> seeds = read_seeds(argc - 2, argv + 2);
  if (seeds.empty()) {
    std::fprintf(stderr, "there are no seeds\n");
    return 2;
  }
  const long count = std::atol(argv[1]);
  double slowest = 0;
  const auto run = [&](const Bytes& bytes, const char* what, long number) {
    const auto start = std::chrono::steady_clock::now();
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    slowest = std::max(slowest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    if (slowest > 30) {
      std::fprintf(stderr, "FINDING: %s %ld takes %.0f s\n", what, number, slowest);
      std::exit(1);
    }
  };
  for (std::size_t i = 0; i < seeds.size(); i++) run(seeds[i], "seed", static_cast<long>(i));
  Mutator mutator(seeds);
  for (long i = 0; i < count; i++) run(mutator.next(), "mutation", i);
  std::printf("%zu seeds and %ld mutations, none of them a finding; the slowest took %.3f s\n", seeds.size(), count, slowest);
  return 0;
}
