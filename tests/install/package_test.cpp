// Debian packages.
#include <gtest/gtest.h>

#include "tests/bundled_cases.hpp"
#include "tests/install/shell.hpp"

namespace casimir::test {
namespace {

TEST(Package, DebianPackagesAreCleanAndRun) {
  const Folder folder;
  // Lintian does not know what is quickest.
  const std::string compression = wants_every_case() ? "gzip" : "zstd";
  const Outcome made = shell(folder, "'" CASIMIR_CPACK "' --config '" CASIMIR_BUILD_DIR
                                     "/CPackConfig.cmake' -G DEB -B packages "
                                     "-D CPACK_DEBIAN_COMPRESSION_TYPE=" +
                                         compression + "\n");
  ASSERT_EQ(made.status, 0) << made.out << made.err;
  if (wants_every_case()) {  // it takes longer than all else here
    const Outcome checked = shell(folder, "lintian --allow-root --fail-on error packages/*.deb\n");
    EXPECT_EQ(checked.status, 0) << checked.out << checked.err;
  }

  const std::string program = shell(folder, "dpkg-deb -I packages/casimir_*.deb control\n").out;
  for (const char* need : {"libginac", "libcln", "libflint", "libsundials", "Recommends: g++"})
    EXPECT_TRUE(shows(program, need)) << program;
  const std::string development =
      shell(folder, "dpkg-deb -I packages/libcasimir-dev_*.deb control\n").out;
  for (const char* need : {"libginac-dev", "libflint-dev", "libsundials-dev", "libeigen3-dev"})
    EXPECT_TRUE(shows(development, need)) << development;

  const Outcome run = shell(folder,
                            "for package in packages/*.deb; do dpkg-deb -x $package root; done\n"
                            "root/usr/bin/casimir verify kovalevskaya\n"
                            "ls root/usr/lib/libcasimir_runtime.a "
                            "root/usr/lib/libcasimir_analysis.a root/usr/lib/pkgconfig/casimir.pc "
                            "root/usr/share/man/man1/casimir-verify.1.gz "
                            "root/usr/share/doc/libcasimir-dev/copyright\n");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(shows(run.out, "12 proved, 0 refuted")) << run.out;

  // Where the Python module was built, it finds the cases of the program's package.
  const Outcome python =
      shell(folder,
            "cd root/usr/lib/python3/dist-packages && ls casimir/_core*.so || exit 0\n"
            "PYTHONPATH=$PWD /usr/bin/python3 -c 'import casimir; "
            "print(casimir.load(\"kovalevskaya\").verify().verdict)'\n");
  EXPECT_EQ(python.status, 0) << python.err;
  EXPECT_TRUE(!shows(python.out, "_core") || shows(python.out, "proved")) << python.out;
}

}  // namespace
}  // namespace casimir::test
