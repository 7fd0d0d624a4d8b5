#include <catch2/catch.hpp>
#include <filesystem>

#include "bench/text_file.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/factory/judged_runs.hpp"
#include "tests/factory/mosquitto.hpp"

namespace rvbench::test {
namespace {

using Catch::Contains;
using test::passed_run;

void run_in(const std::filesystem::path& folder, const std::vector<std::string>& words) {
  const Answer answer = Program(folder, words).wait();
  INFO(answer.err);
  REQUIRE(answer.code == 0);
}

// A certificate that signs itself, <name>.pem with <name>.key, for that host.
void certify(const std::filesystem::path& folder, const std::string& name,
             const std::string& host) {
  run_in(folder,
         {"/usr/bin/openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt",
          "ec_paramgen_curve:prime256v1", "-nodes", "-days", "2", "-subj", "/CN=" + name, "-addext",
          "subjectAltName=" + host, "-keyout", name + ".key", "-out", name + ".pem"});
}

void write_password(const std::filesystem::path& folder, const std::string& password) {
  bench::write_file(folder / "password", password + "\n");
  using std::filesystem::perms;
  std::filesystem::permissions(folder / "password", perms::owner_read | perms::owner_write);
}

}  // namespace

TEST_CASE("a broker that asks for a password gets it, and a wrong one is told", "[factory][who]") {
  const ScratchFolder keys, root;
  run_in(keys.path(),
         {"/usr/bin/mosquitto_passwd", "-b", "-c", (keys / "users").string(), "b3", "right-word"});
  const Mosquitto mosquitto("allow_anonymous false\npassword_file " + (keys / "users").string());
  judged_run(root.path(), passed_run(), "A17");
  const std::string broker =
      broker_file(keys.path(), mosquitto.port(), R"(, "user": "b3", "password_file": "password")");
  write_password(keys.path(), "wrong-word");
  const Answer refused = publish(root.path(), broker);
  CHECK(refused.code == 30);
  CHECK_THAT(refused.err, Contains("does not let this \"user\" in with this password"));
  CHECK_THAT(refused.err + refused.out, !Contains("wrong-word"));

  write_password(keys.path(), "right-word");
  const Answer sent = publish(root.path(), broker);
  CHECK(sent.code == 0);
  CHECK_THAT(sent.out, Contains("acknowledged: A17/") && !Contains("sent before"));
}

TEST_CASE("over TLS a broker must be the one that the authority vouches for", "[factory][who]") {
  const ScratchFolder keys, root;
  certify(keys.path(), "broker", "IP:127.0.0.1");
  certify(keys.path(), "elsewhere", "DNS:broker.example");
  const auto with = [&](const std::string& certificate) {
    return "allow_anonymous true\ncertfile " + (keys / certificate).string() + ".pem\nkeyfile " +
           (keys / certificate).string() + ".key";
  };
  judged_run(root.path(), passed_run(), "A17");
  const auto published = [&](const Mosquitto& mosquitto, const std::string& authority) {
    return publish(root.path(), broker_file(keys.path(), mosquitto.port(),
                                            R"(, "tls": {"ca": ")" + authority + ".pem\"}"));
  };
  {
    const Mosquitto mosquitto(with("broker"));
    const Answer wrong_authority = published(mosquitto, "elsewhere");
    CHECK(wrong_authority.code == 30);
    CHECK_THAT(wrong_authority.err, Contains("must be signed by what \"ca\" holds"));
    const Answer in_the_open = publish(root.path(), broker_file(keys.path(), mosquitto.port()));
    CHECK(in_the_open.code == 30);
    const Mosquitto other(with("elsewhere"));
    CHECK(published(other, "elsewhere").code == 30);  // good, but of another host
    CHECK(mosquitto.publications("d0", "rvbench/b3/result") == 0);
    CHECK(other.publications("d0", "rvbench/b3/result") == 0);
  }
  const Mosquitto mosquitto(with("broker"));
  const Answer sent = published(mosquitto, "broker");
  INFO(sent.err);
  CHECK(sent.code == 0);
  CHECK(mosquitto.publications("d0, q1", "rvbench/b3/result") == 1);
}

}  // namespace rvbench::test
