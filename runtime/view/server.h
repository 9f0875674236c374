// Serves a session to a browser on this machine. Knows HTTP and the page; what a session does is the session's.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "view/session.h"

namespace stokes {

/// Files of a record, made when a viewer asks for them.
struct SaveFormats {
  /// The bytes of "exr" or "png" (with an exposure in stops).
  std::function<std::string(const FilmRecord&, const std::string& format, double exposure)> bytes;
  /// Writes the same file where the user said, and returns its path. Throws OutputError.
  std::function<std::string(const FilmRecord&, const std::string& format, double exposure)> write;
};

class ViewServer {
 public:
  /// `title` is what the page is called. The session must outlive the server.
  ViewServer(Session& session, SaveFormats formats, std::string title);
  ~ViewServer();
  /// Listens on 127.0.0.1; port 0 takes a free one. Returns the port, or 0 when it is not to be had.
  int start(int port);
  /// Ends all connections and the server's threads.
  void stop();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace stokes
