#!/bin/sh
# The Makefile and the rules of the house.
. "$(dirname "$0")/lib.sh"

# The variables that `make test` was called with hold for these calls too, its threads do not.
MAKEFLAGS=$(printf '%s' "${MAKEFLAGS:-}" | sed 's/--jobserver[^ ]*//g; s/-j *[0-9]*//g')
run_make() { make --no-print-directory -C "$root" BUILD="$KITSUKE_BUILD" DEPS=no "$@"; }

like 'make help tells of every target' "$(run_make help | awk '{ printf "%s ", $1 }')" \
    '^all demo figures motions test test-faults test-cluster check bench lint fuzz format install uninstall dist clean'
ok 'a build that is none of the three is refused' must_fail 2 run_make BUILD=fast
like 'by name' "$(cat err)" "BUILD must be release, debug or san, not 'fast'"

like 'clang, wherever it is, asks for its own C++ compiler' \
    "$(MAKEFLAGS='' run_make -n V=1 OUT="$scratch/out" CC='ccache /opt/clang+llvm/bin/clang-18 -m64')" \
    '^ccache /opt/clang\+llvm/bin/clang\+\+-18 -m64 .*-c src/files/drc\.cpp'

like 'make -R, which knows no compiler, asks for c++' \
    "$(unset CC CXX; MAKEFLAGS='' run_make -R -n V=1 OUT="$scratch/out")" '^c\+\+ .*-c src/files/drc\.cpp'

if [ "$KITSUKE" = "$root/build/$KITSUKE_BUILD/kitsuke" ]; then
    ok 'make install, where names have blanks' run_make install DESTDIR="$scratch/a stage" PREFIX='/my opt'
    there="$scratch/a stage/my opt" share="$scratch/a stage/my opt/share/kitsuke"
    is 'puts the program there' "$("$there/bin/kitsuke" --version)" "$("$KITSUKE" --version)"
    ok 'with the garments' cmp "$share/garments/skirt.garment" "$root/garments/skirt.garment"
    ok 'and the walk' cmp "$share/motions/paper-walk.bvh" "$root/motions/paper-walk.bvh"
    ok 'make uninstall' run_make uninstall DESTDIR="$scratch/a stage" PREFIX='/my opt'
    is 'leaves no file' "$(find 'a stage' -type f)" ''
else
    skip 'make install' "not the build of this folder: $KITSUKE"
fi

# Lint on a small house.
mkdir -p house/.ci house/tests house/include/base house/include/files house/src/base house/src/files
cp "$root/.ci/lint.sh" "$root/.ci/run" house/.ci
cp "$root/tests/lib.sh" house/tests
printf '#!/bin/sh\n' >house/tests/some.sh && chmod +x house/tests/some.sh
printf '/* Errors. */\n' >house/include/base/error.h
printf '/* Meshes. */\n' >house/include/files/obj.h
good='/* Errors. */\n#include "base/error.h"\n'
lint_of() { # lint_of FILE TEXT: what lint says with such a file
    printf "$2" >"house/$1"
    sh house/.ci/lint.sh house
    rm "house/$1"
}
is 'a good file passes' "$(lint_of src/base/error.c "$good")" ''
is 'a higher floor is refused' "$(lint_of src/base/error.c "$good#include \"files/obj.h\"\n")" \
    'src/base/error.c:3: base includes files/obj.h, a higher floor'
is 'a lower one is not' \
    "$(lint_of src/files/obj.c '/* Meshes. */\n#include "files/obj.h"\n#include "base/error.h"\n')" ''
like 'an include without a floor' "$(lint_of src/base/error.c "$good#include \"obj.h\"\n")" 'names no floor'
like 'the own header comes first' \
    "$(lint_of src/base/error.c '/* Errors. */\n#include <stdio.h>\n')" 'begin with #include "base/error.h"'
like 'a tab' "$(lint_of src/base/error.c "$good\tint x;\n")" ':3: a tab'
like 'a blank at the end' "$(lint_of src/base/error.c "${good}int x; \n")" ':3: a blank at the end'
like 'a long line' "$(lint_of src/base/error.c "$good$(printf '%0121d' 0)\n")" ':3: more than 120 columns'
like 'a long file' "$(lint_of src/base/error.c "$good$(printf '%0499d' 0 | sed 's/0/\\n/g')")" \
    ':501: more than 500 lines'
like 'an exit below main' "$(lint_of src/base/error.c "${good}void f(void) { exit(1); }\n")" 'error.c:3:.*exit'
like 'a file at the top level' "$(lint_of notes.txt 'x\n')" 'notes.txt: not agreed on'
done_testing
