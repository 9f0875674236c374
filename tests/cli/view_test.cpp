// `stokes view` as a browser meets it: the program is started on a tiny scene and asked over HTTP. On the reference, which needs no OpenCL.
#include <gmock/gmock.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

namespace stokes {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

std::string read_file(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// A folder with small.json as scene.json, gone at the end.
class Folder {
 public:
  Folder() {
    std::string name = testing::TempDir() + "stokes_view_XXXXXX";
    path_ = mkdtemp(name.data());
    write(read_file(STOKES_SOURCE_DIR "/tests/cli/small.json"));
  }
  ~Folder() { fs::remove_all(path_); }
  void write(const std::string& text) const { std::ofstream(path_ / "scene.json") << text; }
  void replace(const std::string& from, const std::string& to) const {
    std::string text = read_file(path_ / "scene.json");
    text.replace(text.find(from), from.size(), to);
    write(text);
  }
  int shell(const std::string& command) const { return std::system(("cd '" + path_.string() + "' && " + command).c_str()); }
  fs::path operator/(const std::string& name) const { return path_ / name; }
  std::string path() const { return path_; }

 private:
  fs::path path_;
};

/// The running program and its address.
class Viewer {
 public:
  Viewer(const Folder& folder, const std::vector<std::string>& options = {}) {
    std::array<int, 2> out{};
    if (pipe(out.data()) != 0) throw std::runtime_error("pipe");
    pid_ = fork();
    if (pid_ == 0) {
      dup2(out[1], STDOUT_FILENO);
      close(out[0]);
      close(out[1]);
      if (chdir(folder.path().c_str()) != 0) _exit(99);
      std::vector<std::string> words = {STOKES_PROGRAM, "view", "scene.json", "--port", "0", "--device", "reference", "-q"};
      words.insert(words.end(), options.begin(), options.end());
      std::vector<char*> arguments;
      for (std::string& word : words) arguments.push_back(word.data());
      arguments.push_back(nullptr);
      execv(arguments[0], arguments.data());
      _exit(98);
    }
    close(out[1]);
    FILE* stream = fdopen(out[0], "r");
    if (std::fscanf(stream, "http://127.0.0.1:%d/", &port_) != 1) port_ = 0;
    std::fclose(stream);
  }
  ~Viewer() { end(SIGKILL); }
  int port() const { return port_; }
  httplib::Client client() const {
    httplib::Client client("127.0.0.1", port_);
    client.set_read_timeout(60);
    return client;
  }
  /// Ends it by a signal and returns the exit code, or -1 where the signal did it.
  int end(int signal) {
    if (pid_ == 0) return -1;
    kill(pid_, signal);
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  json state() const {
    const auto answer = client().Get("/state");
    return answer ? json::parse(answer->body) : json();
  }
  /// Polls until `ready` likes the state; a null state after a minute.
  template <class Ready>
  json wait(Ready&& ready) const {
    for (int i = 0; i < 600; i++) {
      const json now = state();
      if (!now.is_null() && ready(now)) return now;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return {};
  }
  json wait_done() const {
    return wait([](const json& s) { return s["phase"] == "done" && s["error"].is_null(); });
  }

 private:
  pid_t pid_ = 0;
  int port_ = 0;
};

/// Collects server-sent events in the background.
class Listener {
 public:
  explicit Listener(const Viewer& viewer) : client_(viewer.client()) {
    thread_ = std::thread([this] {
      client_.Get("/events", [this](const char* data, std::size_t size) {
        const std::lock_guard lock(mutex_);
        text_.append(data, size);
        return !done_;
      });
    });
  }
  ~Listener() {
    {
      const std::lock_guard lock(mutex_);
      done_ = true;
    }
    thread_.join();
  }
  /// Waits for `text` in what comes after the last find; false after a minute.
  bool hears(const std::string& text) {
    for (int i = 0; i < 600; i++) {
      {
        const std::lock_guard lock(mutex_);
        const std::size_t at = text_.find(text, from_);
        if (at != std::string::npos) {
          from_ = at + text.size();
          return true;
        }
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return false;
  }

 private:
  httplib::Client client_;
  std::mutex mutex_;
  std::string text_;
  std::size_t from_ = 0;
  bool done_ = false;
  std::thread thread_;
};

httplib::Result post(const Viewer& viewer, const std::string& path, const json& body, httplib::Headers headers = {}) {
  return viewer.client().Post(path.c_str(), headers, body.dump(), "application/json");
}

/// Mean colour of the picture's middle, which is all ball: single pixels of so few samples are too noisy.
std::array<double, 3> middle(const Viewer& viewer) {
  std::array<double, 3> sum{};
  for (int x = 5; x < 11; x++)
    for (int y = 4; y < 9; y++) {
      const json probe = json::parse(viewer.client().Get("/spectrum?x=" + std::to_string(x) + "&y=" + std::to_string(y))->body);
      for (std::size_t c = 0; c < 3; c++) sum[c] += probe["rgb"][c].get<double>() / 30;
    }
  return sum;
}

TEST(View, ServesThePageThePictureAndSpectra) {
  const Folder folder;
  Viewer viewer(folder);
  ASSERT_GT(viewer.port(), 0);
  const json state = viewer.wait_done();
  ASSERT_FALSE(state.is_null());
  EXPECT_EQ(state["samples"], 12);
  EXPECT_EQ(state["device"], "reference");

  const auto page = viewer.client().Get("/");
  ASSERT_TRUE(page);
  EXPECT_THAT(page->body, HasSubstr("</html>"));
  EXPECT_THAT(page->get_header_value("Content-Security-Policy"), HasSubstr("default-src 'none'"));

  const auto frame = viewer.client().Get("/frame?layer=picture");
  ASSERT_TRUE(frame);
  ASSERT_EQ(frame->body.size(), 32u + 16 * 12 * 3 * 2);
  EXPECT_EQ(viewer.client().Get("/frame?layer=depth")->body.size(), 32u + 16 * 12 * 2);
  EXPECT_EQ(viewer.client().Get("/frame?layer=nothing")->status, 400);

  const auto spectrum = viewer.client().Get("/spectrum?x=8.5&y=6.5");
  ASSERT_TRUE(spectrum);
  const json probe = json::parse(spectrum->body);
  EXPECT_EQ(probe["spectrum"].size(), 50u);
  EXPECT_GT(probe["energy"], 0);
  EXPECT_GT(middle(viewer)[0], 2 * middle(viewer)[2]) << "the ball is red";
  EXPECT_EQ(viewer.client().Get("/spectrum?x=16&y=6")->status, 404);
  EXPECT_EQ(viewer.client().Get("/spectrum?x=nan&y=6")->status, 400);
  EXPECT_EQ(viewer.end(SIGINT), 0);
}

TEST(View, SavesWhatRenderWouldHaveMade) {
  const Folder folder;
  Viewer viewer(folder, {"-o", "look.exr"});
  ASSERT_FALSE(viewer.wait_done().is_null());
  const auto saved = post(viewer, "/save", {{"format", "exr"}});
  ASSERT_TRUE(saved);
  EXPECT_EQ(json::parse(saved->body)["path"], fs::canonical(folder / "look.exr").string());
  ASSERT_EQ(folder.shell(STOKES_PROGRAM " render scene.json --device reference -q -o render.exr --spectral 280:780:50 --aov albedo,normal,depth,variance >/dev/null"), 0);
  EXPECT_EQ(folder.shell(STOKES_PROGRAM " compare look.exr render.exr --exact >/dev/null"), 0);
  const auto png = viewer.client().Get("/picture.png?exposure=1");
  ASSERT_TRUE(png);
  EXPECT_EQ(png->body.substr(1, 3), "PNG");
  EXPECT_EQ(post(viewer, "/save", {{"format", "../x"}})->status, 400);
  EXPECT_EQ(viewer.end(SIGTERM), 0);
}

TEST(View, AnswersItsOwnPageOnly) {
  const Folder folder;
  Viewer viewer(folder);
  ASSERT_FALSE(viewer.wait_done().is_null());
  EXPECT_EQ(viewer.client().Get("/state", {{"Host", "evil.example:" + std::to_string(viewer.port())}})->status, 403);
  EXPECT_EQ(viewer.client().Get("/frame", {{"Host", "127.0.0.1.evil.example"}})->status, 403);
  EXPECT_EQ(post(viewer, "/stop", {}, {{"Origin", "http://evil.example"}})->status, 403);
  EXPECT_EQ(post(viewer, "/stop", {}, {{"Origin", "http://127.0.0.1:" + std::to_string(viewer.port())}})->status, 200);
  EXPECT_EQ(viewer.client().Get("/state", {{"Host", "localhost:9"}})->status, 200) << "by a tunnel";
  // A second viewer cannot take the same port in silence.
  EXPECT_EQ(WEXITSTATUS(folder.shell(STOKES_PROGRAM " view scene.json --device reference -q --port " + std::to_string(viewer.port()) + " 2>/dev/null")), 5);
}

TEST(View, AnEditIsRenderedAndAnErrorKeepsThePicture) {
  const Folder folder;
  Viewer viewer(folder);
  ASSERT_FALSE(viewer.wait_done().is_null());
  Listener listener(viewer);
  ASSERT_TRUE(listener.hears("event: state\ndata: {"));
  ASSERT_TRUE(listener.hears("event: frame\ndata: "));
  const std::string before = viewer.client().Get("/frame")->body;

  folder.replace("\"albedo\": [0.7", "\"albedo\": [7.0, \"x\"");
  ASSERT_TRUE(listener.hears("\"line\":6"));
  const json broken = viewer.state();
  EXPECT_THAT(broken["error"]["source"], HasSubstr("7.0, \"x\""));
  EXPECT_TRUE(viewer.client().Get("/frame")->body == before) << "the last good picture";

  folder.replace("[7.0, \"x\", 0.2, 0.1]", "[0.1, 0.2, 0.7]");
  ASSERT_TRUE(listener.hears("event: frame"));
  ASSERT_FALSE(viewer.wait_done().is_null());
  EXPECT_GT(middle(viewer)[2], 2 * middle(viewer)[0]) << "the ball is blue";
  // A change that changes nothing keeps the render.
  const json state = viewer.state();
  folder.replace("\"camera\"", "  \"camera\"");
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  EXPECT_EQ(viewer.state()["frame"], state["frame"]);
}

TEST(View, MovesTheCameraStopsAndGoesOn) {
  const Folder folder;
  Viewer viewer(folder);
  ASSERT_FALSE(viewer.wait_done().is_null());
  const std::string before = viewer.client().Get("/frame")->body;
  ASSERT_EQ(post(viewer, "/camera", {{"around", 0.7}, {"up", 0.2}, {"zoom", 0.8}})->status, 200);
  ASSERT_FALSE(viewer.wait([](const json& s) { return s["phase"] == "done" && s["moved"] == true; }).is_null());
  EXPECT_FALSE(viewer.client().Get("/frame")->body.substr(32) == before.substr(32)) << "the picture of before the move";
  ASSERT_EQ(post(viewer, "/camera", {{"reset", true}})->status, 200);
  ASSERT_FALSE(viewer.wait([](const json& s) { return s["phase"] == "done" && s["moved"] == false; }).is_null());
  EXPECT_TRUE(viewer.client().Get("/frame")->body.substr(32) == before.substr(32)) << "the same place, the same bits";
  EXPECT_EQ(post(viewer, "/camera", {{"zoom", -1}})->status, 400);
  EXPECT_EQ(viewer.client().Post("/camera", "no json", "application/json")->status, 400);

  // A finished render gets as many samples again; a stopped one waits.
  ASSERT_EQ(post(viewer, "/resume", {})->status, 200);
  ASSERT_FALSE(viewer.wait([](const json& s) { return s["samples"] == 24; }).is_null());
  folder.replace("\"samples\": 12", "\"samples\": 1000000");
  ASSERT_FALSE(viewer.wait([](const json& s) { return s["phase"] == "rendering" && s["samples_total"] == 1000000; }).is_null());
  ASSERT_EQ(post(viewer, "/stop", {})->status, 200);
  const json stopped = viewer.wait([](const json& s) { return s["phase"] == "stopped"; });
  ASSERT_FALSE(stopped.is_null());
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  const int samples = viewer.state()["samples"];
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_EQ(viewer.state()["samples"], samples);
  EXPECT_LT(samples, 1000000);
  ASSERT_EQ(post(viewer, "/resume", {})->status, 200);
  EXPECT_FALSE(viewer.wait([&](const json& s) { return s["samples"] > samples; }).is_null());
  EXPECT_EQ(viewer.end(SIGINT), 0);
}

/// Takes one connection and returns everything that came over it.
class Receiver {
 public:
  Receiver() : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (bind(socket_, reinterpret_cast<sockaddr*>(&address), size) != 0 || listen(socket_, 1) != 0) throw std::runtime_error("listen");
    getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] {
      const int connection = accept(socket_, nullptr, nullptr);
      std::array<char, 4096> buffer;
      for (ssize_t n = 0; (n = read(connection, buffer.data(), buffer.size())) > 0;) bytes_.append(buffer.data(), static_cast<std::size_t>(n));
      close(connection);
    });
  }
  ~Receiver() {
    if (thread_.joinable()) thread_.join();
    close(socket_);
  }
  int port() const { return port_; }
  std::string bytes() {
    thread_.join();
    return bytes_;
  }

 private:
  int socket_, port_ = 0;
  std::string bytes_;
  std::thread thread_;
};

// The packets' form is tested against tev's own client (unit tests); here it is which of them come.
TEST(View, RenderShowsItsPictureInTev) {
  const Folder folder;
  Receiver receiver;
  ASSERT_EQ(folder.shell(STOKES_PROGRAM " render scene.json --device reference -q --display-server 127.0.0.1:" + std::to_string(receiver.port()) + " >/dev/null"), 0);
  const std::string bytes = receiver.bytes();
  std::string types;
  std::size_t at = 0, last = 0;
  while (at + 5 <= bytes.size()) {
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + at, 4);
    ASSERT_GE(length, 5u);
    types += static_cast<char>('0' + bytes[at + 4]);
    last = at;
    at += length;
  }
  EXPECT_EQ(at, bytes.size());
  EXPECT_EQ(types.substr(0, 2), "46") << "made, then filled";
  EXPECT_EQ(types.find_first_not_of('6', 1), std::string::npos);
  // The last packet is the whole picture; the ball in its middle is red.
  const std::size_t floats = bytes.size() - 16 * 12 * 4 * sizeof(float);
  ASSERT_GT(floats, last);
  float rgba[4];
  std::memcpy(rgba, bytes.data() + floats + (6 * 16 + 8) * sizeof rgba, sizeof rgba);
  EXPECT_GT(rgba[0], rgba[2]);
  EXPECT_EQ(rgba[3], 1);
}

TEST(View, ASceneThatIsWrongFromTheStartEndsIt) {
  const Folder folder;
  folder.replace("\"radius\": 1", "\"radius\": -1");
  EXPECT_EQ(WEXITSTATUS(folder.shell(STOKES_PROGRAM " view scene.json --device reference -q --port 0 2>/dev/null")), 2);
  EXPECT_EQ(WEXITSTATUS(folder.shell(STOKES_PROGRAM " view scene.json --port 70000 2>/dev/null")), 64);
}

}  // namespace
}  // namespace stokes
