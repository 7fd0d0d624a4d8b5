#include <catch2/catch.hpp>
#include <string>

#include "tests/packaging/installed.hpp"
#include "tests/support/this_build.hpp"

namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using test::Answer;
using test::bash;
using test::ScratchFolder;

}  // namespace

TEST_CASE("the Debian package holds what belongs on a bench, and says what it needs",
          "[packaging]") {
  const ScratchFolder folder;
  const Answer made =
      bash(folder.path(), test::build_setting("CMAKE_CPACK_COMMAND") +
                              " -G DEB -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip -B $PWD --config " +
                              test::build_dir().string() +
                              "/CPackConfig.cmake && mv rvbench_*.deb p.deb");
  INFO(made.out << made.err);
  REQUIRE(made.code == 0);
  const std::string fields = bash(folder.path(), "dpkg-deb -f p.deb").out;
  CHECK_THAT(fields, Contains("Package: rvbench\n") && Contains("Version: 0.1.0\n"));
  CHECK_THAT(fields, Contains("Maintainer: rvbench developers <rvbench@example.org>\n"));
  CHECK_THAT(fields, Contains("Description: acceptance test bench for RV reducers\n"));
  // Found by what the program is linked with, not by a list that somebody keeps.
  CHECK_THAT(fields, Contains("libmodbus5") && Contains("libsqlite3-0") && Contains("systemd"));
  const std::string files = bash(folder.path(), "dpkg-deb -c p.deb").out;
  for (const char* file :
       {"./usr/bin/rvbench\n", "./usr/share/man/man1/rvbench.1.gz\n",
        "./usr/lib/systemd/system/rvbench.service\n",
        "./usr/lib/systemd/system/rvbench-publish.service\n",
        "./usr/lib/udev/rules.d/70-rvbench.rules\n", "./usr/lib/sysusers.d/rvbench.conf\n",
        "./usr/share/bash-completion/completions/rvbench\n",
        "./usr/share/rvbench/rigs/rv20e_bench.json\n",
        "./usr/share/doc/rvbench/guide/your_bench.md\n"}) {
    CHECK_THAT(files, Contains(file));
  }
  CHECK_THAT(files, !Contains("./usr/local") && !Contains("./home") && !Contains("./etc"));
  CHECK(bash(folder.path(), "dpkg-deb -c p.deb | grep -v root/root").out == "");
  CHECK_THAT(bash(folder.path(),
                  "dpkg-deb -x p.deb x && grep ^Exec x/usr/lib/systemd/system/rvbench.service")
                 .out,
             Contains("ExecStart=/usr/bin/rvbench serve"));
  const Answer scripts =
      bash(folder.path(), "dpkg-deb -e p.deb c && for s in c/p*; do sh -n $s && test -x $s; done");
  CHECK(scripts.code == 0);
}

}  // namespace rvbench
