// Serves a session to a browser on this machine. See server.h.
#include "view/server.h"

#include <httplib.h>
#include <sys/socket.h>

#include <atomic>
#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "view/local_only.h"
#include "view/pages.h"
#include "view/state_json.h"

namespace stokes {
namespace {

using Json = nlohmann::json;
using httplib::Request;
using httplib::Response;

// Every open page holds a thread for its events, and each connection one for as long as it is kept.
constexpr int kThreads = 32, kMostListeners = 12;
constexpr auto kEventPause = std::chrono::milliseconds(40), kHeartbeat = std::chrono::milliseconds(1000);
constexpr std::size_t kLargestBody = 4096;

void refuse(Response& response, int status, const std::string& why) {
  response.status = status;
  response.set_content(Json{{"error", why}}.dump(), "application/json");
}

double number(const Json& j, const char* key, double fallback) {
  const auto found = j.find(key);
  if (found == j.end()) return fallback;
  const double value = found->get<double>();
  if (!std::isfinite(value) || std::fabs(value) > 1e3) throw std::invalid_argument(std::string(key) + " is out of range");
  return value;
}

double query_number(const Request& request, const char* key, double fallback) {
  if (!request.has_param(key)) return fallback;
  const double value = std::stod(request.get_param_value(key));
  if (!std::isfinite(value)) throw std::invalid_argument(std::string(key) + " is not a number");
  return value;
}

CameraMove read_move(const std::string& body) {
  const Json j = Json::parse(body);
  CameraMove move;
  move.around = number(j, "around", 0);
  move.up = number(j, "up", 0);
  move.shift_right = number(j, "right", 0);
  move.shift_up = number(j, "lift", 0);
  move.zoom = number(j, "zoom", 1);
  if (!(move.zoom > 0)) throw std::invalid_argument("zoom must be positive");
  move.reset = j.value("reset", false);
  return move;
}

}  // namespace

struct ViewServer::Impl {
  Session& session;
  SaveFormats formats;
  std::string title;
  httplib::Server http;
  std::thread thread;
  std::atomic<bool> ending{false};
  std::atomic<int> listeners{0};

  Impl(Session& s, SaveFormats f, std::string t) : session(s), formats(std::move(f)), title(std::move(t)) {
    http.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    // Not the library's choice, which lets two servers share a port in silence.
    http.set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    http.set_payload_max_length(kLargestBody);
    http.set_keep_alive_timeout(2);
    http.set_default_headers({{"X-Content-Type-Options", "nosniff"},
                              {"X-Frame-Options", "DENY"},
                              {"Referrer-Policy", "no-referrer"},
                              {"Cross-Origin-Resource-Policy", "same-origin"},
                              {"Cache-Control", "no-store"}});
    http.set_pre_routing_handler([](const Request& request, Response& response) {
      const std::string host = request.get_header_value("Host");
      const bool ours = is_local_host(host) && is_same_origin(request.get_header_value("Origin"), host);
      if (!ours) refuse(response, 403, "this server answers its own page on this machine only");
      return ours ? httplib::Server::HandlerResponse::Unhandled : httplib::Server::HandlerResponse::Handled;
    });
    http.set_exception_handler([](const Request&, Response& response, std::exception_ptr thrown) {
      try {
        std::rethrow_exception(thrown);
      } catch (const std::exception& error) {
        refuse(response, 400, error.what());
      }
    });
    add_reading();
    add_acting();
  }

  void add_reading() {
    http.Get("/", [](const Request&, Response& response) {
      response.set_header("Content-Security-Policy",
                          "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; connect-src 'self'; img-src 'self' data: "
                          "blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
      response.set_content(page_files().at("viewer.html"), "text/html; charset=utf-8");
    });
    http.Get("/state", [this](const Request&, Response& response) { response.set_content(state_text(session.state()), "application/json"); });
    http.Get("/frame", [this](const Request& request, Response& response) {
      const std::string bytes = session.frame(request.has_param("layer") ? request.get_param_value("layer") : "picture");
      if (bytes.empty()) return refuse(response, 503, "there is no picture yet");
      response.set_content(bytes, "application/octet-stream");
    });
    http.Get("/spectrum", [this](const Request& request, Response& response) {
      const auto probe = session.probe(query_number(request, "x", -1), query_number(request, "y", -1), query_number(request, "radius", 0));
      if (!probe) return refuse(response, 404, "there is no such pixel");
      response.set_content(to_json(*probe), "application/json");
    });
    http.Get("/events", [this](const Request&, Response& response) { listen(response); });
    http.Get(R"(/picture\.(exr|png))", [this](const Request& request, Response& response) {
      const auto record = session.record();
      if (!record) return refuse(response, 503, "there is no full picture yet");
      const std::string format = request.matches[1];
      response.set_content(formats.bytes(*record, format, query_number(request, "exposure", 0)), format == "png" ? "image/png" : "image/x-exr");
      response.set_header("Content-Disposition", "attachment; filename=\"" + title + "." + format + "\"");
    });
  }

  void add_acting() {
    const auto done = [](Response& response) { response.set_content("{}", "application/json"); };
    http.Post("/camera", [this, done](const Request& request, Response& response) {
      session.move(read_move(request.body));
      done(response);
    });
    http.Post("/stop", [this, done](const Request&, Response& response) {
      session.stop();
      done(response);
    });
    http.Post("/resume", [this, done](const Request&, Response& response) {
      session.resume();
      done(response);
    });
    http.Post("/save", [this](const Request& request, Response& response) {
      const Json j = Json::parse(request.body);
      const std::string format = j.at("format");
      if (format != "exr" && format != "png") return refuse(response, 400, "format is exr or png");
      const auto record = session.record();
      if (!record) return refuse(response, 503, "there is no full picture yet");
      response.set_content(Json{{"path", formats.write(*record, format, number(j, "exposure", 0))}}.dump(), "application/json");
    });
  }

  std::string state_text(const SessionState& state) const {
    std::string text = to_json(state);
    text.insert(1, "\"title\":" + Json(title).dump(-1, ' ', false, Json::error_handler_t::replace) + ",");
    return text;
  }

  /// Server-sent events: `state` whenever something changed, and `frame` with its number whenever there is a new picture.
  void listen(Response& response) {
    if (++listeners > kMostListeners) {
      listeners--;
      return refuse(response, 503, "too many pages are open");
    }
    auto told = std::make_shared<std::pair<std::uint64_t, std::uint32_t>>(~std::uint64_t{0}, 0u);
    response.set_chunked_content_provider(
        "text/event-stream",
        [this, told](std::size_t, httplib::DataSink& sink) {
          if (ending || !sink.is_writable()) return false;
          const SessionState state = session.wait(told->first, kHeartbeat);
          if (ending) return false;
          std::string text = ": still here\n\n";  // else a page that was closed would be noticed at the next change only
          if (state.version != told->first) text = "event: state\ndata: " + state_text(state) + "\n\n";
          if (state.frame != told->second) text += "event: frame\ndata: " + std::to_string(state.frame) + "\n\n";
          *told = {state.version, state.frame};
          const bool written = sink.write(text.data(), text.size());
          std::this_thread::sleep_for(kEventPause);
          return written;
        },
        [this](bool) { listeners--; });
  }
};

ViewServer::ViewServer(Session& session, SaveFormats formats, std::string title)
    : impl_(std::make_unique<Impl>(session, std::move(formats), std::move(title))) {}

ViewServer::~ViewServer() { stop(); }

int ViewServer::start(int port) {
  if (port == 0)
    port = impl_->http.bind_to_any_port("127.0.0.1");
  else if (!impl_->http.bind_to_port("127.0.0.1", port))
    port = 0;
  if (port <= 0) return 0;
  impl_->thread = std::thread([this] { impl_->http.listen_after_bind(); });
  return port;
}

void ViewServer::stop() {
  impl_->ending = true;
  if (!impl_->thread.joinable()) return;
  impl_->http.stop();
  impl_->thread.join();
}

}  // namespace stokes
