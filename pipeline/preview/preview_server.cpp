#include "pipeline/preview/preview_server.h"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/random.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>

#include "pipeline/diagram/page.h"
#include "pipeline/image/errors.h"
#include "pipeline/preview/live_show.h"
#include "pipeline/preview/page_files.h"
#include "pipeline/preview/patient_server.h"
#include "pipeline/preview/screen_view.h"
#include "pipeline/preview/show_facts.h"
#include "pipeline/preview/warning_finder.h"

namespace domefall {
namespace {

// As many connections are served at once.  Most of them only wait, for news or for their turn.
constexpr std::size_t kConnections = 48;
constexpr int kPatienceSeconds = 2;  // with a slow or silent client
constexpr int kNewsSeconds = 20, kMostWaitingForNews = 16;
constexpr std::size_t kLongestBody = 1024;  // no request has one

std::string new_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw TemporaryError("the system gives no random numbers for the preview's address");
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

// httplib waits by select(), which knows no descriptor beyond 1023.
void limit_descriptors() {
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, FD_SETSIZE - 1);
  setrlimit(RLIMIT_NOFILE, &limit);
}

// Compares in a time that does not tell how much was right.
bool same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned differences = 0;
  for (std::size_t k = 0; k < a.size(); ++k) differences |= static_cast<unsigned>(a[k] ^ b[k]);
  return differences == 0;
}

long whole_parameter(const httplib::Request& request, const char* name) {
  const std::string text = request.get_param_value(name);
  long value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

// Counts the requests that are within a scope.
class CountedIn {
 public:
  explicit CountedIn(std::atomic<int>& count) : count_(count), number_(++count) {}
  CountedIn(const CountedIn&) = delete;
  CountedIn(CountedIn&&) = delete;
  CountedIn& operator=(const CountedIn&) = delete;
  CountedIn& operator=(CountedIn&&) = delete;
  ~CountedIn() { --count_; }

  int number() const { return number_; }

 private:
  std::atomic<int>& count_;
  int number_;
};

Parameters parameters_of(const httplib::Request& request) {
  return [&request](std::string_view name) -> std::optional<std::string> {
    const auto found = request.params.find(std::string(name));
    if (found == request.params.end()) return std::nullopt;
    return found->second;
  };
}

void answer_text(httplib::Response& response, int status, const std::string& text) {
  response.status = status;
  response.set_content(text + "\n", "text/plain; charset=utf-8");
}

void answer_json(httplib::Response& response, const std::string& json) {
  response.set_content(json, "application/json");
}

// What the page needs to know of a picture to turn it, in a header.
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
  int port = 0;
  std::atomic<int> waiting_for_news = 0;
  std::atomic<std::uint64_t> nobodies = 0;
  PatientServer http;

  Inside(const std::filesystem::path& file, int wanted_port, int threads) : show(file, threads) {
    limit_descriptors();
    http.new_task_queue = [] { return new httplib::ThreadPool(kConnections); };
    http.set_read_timeout(kPatienceSeconds);
    http.set_write_timeout(kPatienceSeconds);
    http.set_keep_alive_timeout(kPatienceSeconds);
    http.set_keep_alive_max_count(1'000'000);
    http.set_payload_max_length(kLongestBody);
    http.set_tcp_nodelay(true);
    // httplib's own options let a second program take the same port.
    http.set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    http.set_default_headers(
        {{"Cache-Control", "no-store"},
         {"X-Content-Type-Options", "nosniff"},
         {"Referrer-Policy", "no-referrer"},
         {"Cross-Origin-Resource-Policy", "same-origin"},
         {"Content-Security-Policy",
          "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; "
          "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"}});
    http.set_pre_routing_handler([this](const auto& request, auto& response) {
      return is_ours(request) ? httplib::Server::HandlerResponse::Unhandled : refused(response);
    });
    http.set_exception_handler([](const auto&, auto& response, std::exception_ptr thrown) {
      try {
        std::rethrow_exception(thrown);
      } catch (const InputError& error) {
        answer_text(response, 400, error.what());
      } catch (const std::exception& error) {
        answer_text(response, 503, error.what());
      } catch (...) {
        answer_text(response, 503, "the picture was given up");
      }
    });
    add_pages();
    if (wanted_port == 0)
      port = http.bind_to_any_port("127.0.0.1");
    else
      port = http.bind_to_port("127.0.0.1", wanted_port) ? wanted_port : -1;
    if (port <= 0)
      throw TemporaryError(fmt::format("127.0.0.1:{}: the port cannot be had", wanted_port));
    url = fmt::format("http://127.0.0.1:{}/{}/", port, token);
  }

  static httplib::Server::HandlerResponse refused(httplib::Response& response) {
    answer_text(response, 403, "this is not the address that domefall preview has printed");
    return httplib::Server::HandlerResponse::Handled;
  }

  // A page of another origin may make the browser ask, even under a name of its own that leads
  // here, but it cannot change Host, Origin or Sec-Fetch-Site, and does not know the token.  An ssh
  // tunnel may end at another port.
  bool is_ours(const httplib::Request& request) const {
    const std::string host = request.get_header_value("Host");
    const std::string name = host.substr(0, host.rfind(':'));
    if (name != "127.0.0.1" && name != "localhost") return false;
    const std::string origin = request.get_header_value("Origin");
    if (!origin.empty() && origin != "http://" + host) return false;
    const std::string site = request.get_header_value("Sec-Fetch-Site");
    if (!site.empty() && site != "same-origin" && site != "none") return false;
    if (request.method != "GET" && request.method != "HEAD") return false;
    const std::string& path = request.path;
    return path.size() > token.size() + 1 && path[0] == '/' && path[token.size() + 1] == '/' &&
           same_secret(std::string_view(path).substr(1, token.size()), token);
  }

  void on(const std::string& name, httplib::Server::Handler handler) {
    http.Get("/" + token + "/" + name, std::move(handler));
  }

  void add_pages() {
    for (const PageFile& file : page_files()) {
      const auto send = [file](const auto&, auto& response) {
        response.set_content(file.bytes.data(), file.bytes.size(), std::string(file.type));
      };
      on(std::string(file.name), send);
      if (file.name == "index.html") on("", send);
    }
    on("show", [this](const auto&, auto& response) {
      answer_json(response, show_facts(show.version(), show.threads()));
    });
    on("warnings",
       [this](const auto&, auto& response) { answer_json(response, warnings.as_json()); });
    on("plot.svg", [this](const auto&, auto& response) {
      response.set_content(show_page(*show.version().show), "image/svg+xml");
    });
    on("picture", [this](const auto& request, auto& response) { picture(request, response); });
    on("changes", [this](const auto& request, auto& response) { changes(request, response); });
    on("probe", [this](const auto& request, auto& response) {
      const PixelPosition at{number(request, "x"), number(request, "y")};
      show.with_pictures([&](LivePictures& pictures) {
        const PictureRequest asked = read_request(parameters_of(request), pictures.show());
        answer_json(response, pictures.probe(asked, at));
      });
    });
    on("camera", [this](const auto& request, auto& response) { camera(request, response); });
  }

  static double number(const httplib::Request& request, const char* name) {
    const std::string text = request.get_param_value(name);
    double value = 0;
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    if (read.ec != std::errc{} || read.ptr != end || !(std::abs(value) < 1e6))
      throw InputError(fmt::format("{} must be a place in pixels, counted from 1", name));
    return value;
  }

  void picture(const httplib::Request& request, httplib::Response& response) {
    const bool can_stop = request.get_param_value("detail") != "moving";
    // Who does not say who it is has no newer requests.
    std::string name = request.get_param_value("client").substr(0, 40);
    name = name.empty() ? fmt::format("nobody {}", ++nobodies)
                        : "client " + name + ' ' + request.get_param_value("kind").substr(0, 10);
    auto made =
        show.picture(parameters_of(request), {name, whole_parameter(request, "n"), can_stop});
    if (!made) {
      response.status = 204;
      return;
    }
    response.set_header("X-Domefall", made_json(*made));
    response.set_content(made->picture.jpeg, "image/jpeg");
  }

  void changes(const httplib::Request& request, httplib::Response& response) {
    const CountedIn waiting(waiting_for_news);
    const LiveShow::Version version =
        show.changed_since(static_cast<int>(whole_parameter(request, "since")),
                           waiting.number() > kMostWaitingForNews ? 0 : kNewsSeconds);
    nlohmann::ordered_json json{
        {"revision", version.revision}, {"readings", version.readings}, {"mistake", nullptr}};
    if (!version.mistake.empty()) json["mistake"] = version.mistake;
    answer_json(response,
                json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  }

  void camera(const httplib::Request& request, httplib::Response& response) {
    show.with_pictures([&](LivePictures& pictures) {
      const FrameState state =
          pictures.state_for(read_request(parameters_of(request), pictures.show()));
      const std::string yaml = camera_as_yaml(pictures.show(), state);
      answer_text(response, 200,
                  request.get_param_value("key") == "1"
                      ? fmt::format("- {{at_s: {:.6g}, camera: {}}}", state.show_time_s, yaml)
                      : "camera: " + yaml);
    });
  }
};

PreviewServer::PreviewServer(const std::filesystem::path& show, int port, int threads)
    : inside_(std::make_unique<Inside>(show, port, threads)) {}

PreviewServer::~PreviewServer() = default;

int PreviewServer::port() const { return inside_->port; }

const std::string& PreviewServer::url() const { return inside_->url; }

void PreviewServer::serve() {
  inside_->http.listen_after_bind();
  inside_->show.stop();
}

void PreviewServer::stop() {
  inside_->show.stop();
  inside_->http.stop();
}

}  // namespace domefall
