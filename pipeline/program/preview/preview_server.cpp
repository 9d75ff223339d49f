#include "pipeline/program/preview/preview_server.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "pipeline/base/errors.h"
#include "pipeline/program/diagram/page.h"
#include "pipeline/program/preview/http_server.h"
#include "pipeline/program/preview/live_show.h"
#include "pipeline/program/preview/page_files.h"
#include "pipeline/program/preview/screen_view.h"
#include "pipeline/program/preview/show_facts.h"
#include "pipeline/theatre/movie/movie_file.h"

namespace domefall {
namespace {

constexpr int kNewsSeconds = 20, kMostWaitingForNews = 16;

std::string new_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw TemporaryError("the system gives no random numbers for the preview's address");
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

// Compares in a time that does not tell how much was right.
bool same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned differences = 0;
  for (std::size_t k = 0; k < a.size(); ++k) differences |= static_cast<unsigned>(a[k] ^ b[k]);
  return differences == 0;
}

// An ssh tunnel may end at another port.
bool is_this_machine(std::string_view host) {
  const std::size_t end = std::min(host.find(':'), host.size());
  const std::string_view name = host.substr(0, end);
  return (name == "127.0.0.1" || name == "localhost") &&
         host.substr(end).find_first_not_of(":0123456789") == std::string_view::npos;
}

long whole_parameter(const HttpRequest& request, std::string_view name) {
  const std::string text = request.parameter(name).value_or("");
  long value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

double pixel_parameter(const HttpRequest& request, std::string_view name) {
  const std::string text = request.parameter(name).value_or("");
  double value = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (read.ec != std::errc{} || read.ptr != end || !(std::abs(value) < 1e6))
    throw InputError(fmt::format("{} must be a place in pixels, counted from 1", name));
  return value;
}

class CountedIn {
 public:
  explicit CountedIn(std::atomic<int>& count) : count_(count), number_(++count) {}
  CountedIn(const CountedIn&) = delete;
  CountedIn& operator=(const CountedIn&) = delete;
  ~CountedIn() { --count_; }

  int number() const { return number_; }

 private:
  std::atomic<int>& count_;
  int number_;
};

Parameters parameters_of(const HttpRequest& request) {
  return [&request](std::string_view name) { return request.parameter(name); };
}

HttpAnswer text_answer(int status, const std::string& text) {
  return {status, "text/plain; charset=utf-8", text + "\n"};
}

HttpAnswer json_answer(std::string json) { return {200, "application/json", std::move(json)}; }

std::string made_json(const LiveShow::Made& made) {
  const FrameState& state = made.picture.state;
  nlohmann::ordered_json camera = nlohmann::ordered_json::array();
  for (int row = 0; row < 3; ++row)
    for (int k = 0; k < 3; ++k) camera.push_back(column(state.camera_from_audience, k)[row]);
  const auto fov = field_of_view(state.projection);
  return nlohmann::ordered_json{{"frame", state.frame},
                                {"revision", made.revision},
                                {"projection", projection_name(state.projection)},
                                {"fov_deg", fov ? *fov * 180 / M_PI : 180},
                                {"width", columns(state.projection)},
                                {"height", rows(state.projection)},
                                {"camera", camera}}
      .dump();
}

}  // namespace

struct PreviewServer::Inside {
  LiveShow show;
  WarningFinder warnings{show};
  std::string token = new_token(), url;
  std::atomic<int> waiting_for_news = 0;
  std::atomic<std::uint64_t> nobodies = 0;
  std::map<std::string, HttpHandler, std::less<>> pages;  // by their names below the token
  HttpServer http;

  Inside(const std::filesystem::path& file, int port, int threads)
      : show(file, threads),
        http(port,
             {{"Cache-Control", "no-store"},
              {"X-Content-Type-Options", "nosniff"},
              {"Referrer-Policy", "no-referrer"},
              {"Cross-Origin-Opener-Policy", "same-origin"},
              {"Cross-Origin-Resource-Policy", "same-origin"},
              {"Content-Security-Policy",
               "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; "
               "media-src blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; "
               "frame-ancestors 'none'"}},
             [this](const HttpRequest& request) { return answer(request); }) {
    add_pages();
    url = fmt::format("http://127.0.0.1:{}/{}/", http.port(), token);
  }

  HttpAnswer answer(const HttpRequest& request) {
    try {
      if (const char* why = refusal(request)) return text_answer(403, why);
      const std::string_view below = std::string_view(request.path).substr(token.size() + 1);
      // Some programs drop the last slash of a link, without which the page would find no other.
      if (below.empty()) return {308, {}, {}, {{"Location", "/" + token + "/"}}};
      const auto page = pages.find(below.substr(1));
      if (page == pages.end()) return text_answer(404, "the preview has no such page");
      return page->second(request);
    } catch (const InputError& error) {
      return text_answer(400, error.what());
    } catch (const std::exception& error) {
      return text_answer(503, error.what());
    } catch (...) {
      return text_answer(503, "the picture was given up");
    }
  }

  // Returns why a request is refused, or nothing if it is not.  A page of another origin may make
  // the browser ask, even under a name of its own that leads here, but it cannot change Host,
  // Origin or Sec-Fetch-*, and does not know the token.  Whoever follows a link to the right
  // address sees it in a window of its own, and the page with the link sees nothing of it.
  const char* refusal(const HttpRequest& request) const {
    const std::string host = request.header("host");
    if (!is_this_machine(host)) return "the preview answers as 127.0.0.1 and localhost only (Host)";
    const std::string origin = request.header("origin");
    if (!origin.empty() && origin != "http://" + host)
      return "this is asked by a page of another address, which the preview does not answer "
             "(Origin)";
    const std::string site = request.header("sec-fetch-site");
    const bool is_followed_link = request.header("sec-fetch-mode") == "navigate" &&
                                  request.header("sec-fetch-dest") == "document";
    if (!site.empty() && site != "same-origin" && site != "none" && !is_followed_link)
      return "this is asked by a page of another site, which the preview does not answer "
             "(Sec-Fetch-Site); open the address in a window of its own";
    if (request.method != "GET" && request.method != "HEAD")
      return "the preview answers GET and HEAD only";
    if (request.has_body) return "the preview answers no request with a body";
    const std::string_view path = request.path;
    if (path.size() <= token.size() || path[0] != '/' ||
        !same_secret(path.substr(1, token.size()), token) ||
        path.substr(token.size() + 1, 1).find_first_not_of('/') != std::string_view::npos)
      return "this is not the address that domefall preview has printed; each start has another "
             "one";
    return nullptr;
  }

  void add_pages() {
    for (const PageFile& file : page_files()) {
      const HttpHandler send = [file](const HttpRequest&) {
        return HttpAnswer{200, std::string(file.type), std::string(file.bytes)};
      };
      pages[std::string(file.name)] = send;
      if (file.name == "index.html") pages[""] = send;
    }
    pages["show"] = [this](const HttpRequest&) {
      return json_answer(show_facts(show.version(), show.threads()));
    };
    pages["warnings"] = [this](const HttpRequest&) { return json_answer(warnings.as_json()); };
    pages["plot.svg"] = [this](const HttpRequest&) {
      return HttpAnswer{200, "image/svg+xml", show_page(*show.version().show)};
    };
    pages["picture"] = [this](const HttpRequest& request) { return picture(request); };
    pages["sound"] = [this](const HttpRequest&) {
      return HttpAnswer{200, "audio/mp4", sound_for_browser(*show.version().show)};
    };
    pages["changes"] = [this](const HttpRequest& request) { return changes(request); };
    pages["probe"] = [this](const HttpRequest& request) { return probe(request); };
    pages["camera"] = [this](const HttpRequest& request) { return camera(request); };
  }

  HttpAnswer picture(const HttpRequest& request) {
    const bool can_stop = request.parameter("detail") != "moving";
    // A request that does not name its client gets a name of its own, so that no other outdates it.
    std::string name = request.parameter("client").value_or("").substr(0, 40);
    name = name.empty()
               ? fmt::format("nobody {}", ++nobodies)
               : "client " + name + ' ' + request.parameter("kind").value_or("").substr(0, 10);
    auto made =
        show.picture(parameters_of(request), {name, whole_parameter(request, "n"), can_stop});
    if (!made) return {.status = 204, .type = {}, .body = {}};
    HttpAnswer answer{200, "image/jpeg", std::move(made->picture.jpeg)};
    answer.headers = {{"X-Domefall", made_json(*made)}};
    return answer;
  }

  HttpAnswer changes(const HttpRequest& request) {
    const CountedIn waiting(waiting_for_news);
    const LiveShow::Version version =
        show.changed_since(static_cast<int>(whole_parameter(request, "since")),
                           waiting.number() > kMostWaitingForNews ? 0 : kNewsSeconds);
    nlohmann::ordered_json json{
        {"revision", version.revision}, {"readings", version.readings}, {"mistake", nullptr}};
    if (!version.mistake.empty()) json["mistake"] = version.mistake;
    return json_answer(json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  }

  HttpAnswer probe(const HttpRequest& request) {
    const PixelPosition at{pixel_parameter(request, "x"), pixel_parameter(request, "y")};
    std::string json;
    show.with_pictures([&](LivePictures& pictures) {
      json = pictures.probe(read_request(parameters_of(request), pictures.show()), at);
    });
    return json_answer(std::move(json));
  }

  HttpAnswer camera(const HttpRequest& request) {
    std::string text;
    show.with_pictures([&](LivePictures& pictures) {
      const PictureRequest wanted = read_request(parameters_of(request), pictures.show());
      const FrameState state = pictures.state_for(wanted);
      const std::string yaml = camera_as_yaml(pictures.show(), state, wanted.look.has_value());
      text = request.parameter("key") == "1"
                 ? fmt::format("- {{at_s: {:.6g}, camera: {}}}", state.show_time_s, yaml)
                 : "camera: " + yaml;
    });
    return text_answer(200, text);
  }
};

PreviewServer::PreviewServer(const std::filesystem::path& show, int port, int threads)
    : inside_(std::make_unique<Inside>(show, port, threads)) {}

PreviewServer::~PreviewServer() = default;

int PreviewServer::port() const { return inside_->http.port(); }

const std::string& PreviewServer::url() const { return inside_->url; }

void PreviewServer::serve() {
  inside_->http.serve();
  inside_->show.stop();
}

void PreviewServer::stop() {
  inside_->show.stop();
  inside_->http.stop();
}

}  // namespace domefall
