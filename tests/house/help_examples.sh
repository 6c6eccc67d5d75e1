#!/bin/sh
# The --help examples of a first session (doctor, run, check, report), typed one after the other on the fixture: every line that help
# shows is one of the real output, in its order, whatever its figures. A line `...` stands for any lines, a trailing ` ...` for the rest
# of its line.
#   help_examples.sh SOURCE PROGRAM
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fixtures=$1/fixtures
mkdir "$work/bin"
ln -s "$2" "$work/bin/luxfit"
PATH=$work/bin:$PATH
cd "$work"
cp -r "$fixtures/office" .

# Figures become #, their padding one space; files are named from where one stands.
shape() { sed -E "s#$work/##g; s/[-+]?[0-9]+(\.[0-9]+)?/#/g; s/[[:space:]]+/ /g; s/^ //; s/ \$//"; }

failed=0
for command in doctor run check report; do
  luxfit "$command" --help | sed -n '/^ *Example:$/,$p' | sed '1d; s/^ *//' >example
  typed=$(sed -n 's/^\$ //p' example)
  [ -n "$typed" ] || { echo "$command: no example" >&2; exit 1; }
  sed '/^\$ /d' example | shape >shown
  sh -c "$typed" >real.txt 2>&1 || [ $? -eq 1 ] || { cat real.txt >&2; echo "failed: $typed" >&2; exit 1; }
  shape <real.txt >real
  [ -s real ] && [ -s shown ] || { echo "$typed: no output to compare" >&2; exit 1; }
  # What is shown, line by line, from where the last one was met.
  awk 'FNR == NR { real[++count] = $0; next }
       $0 == "..." || $0 == "" { next }
       { whole = !sub(/ \.\.\.$/, "")
         for (++at; at <= count && !(whole ? real[at] == $0 : index(real[at], $0) == 1); ++at);
         if (at > count) { print "no such line after the ones before: " $0; exit 1 } }' real shown >missing ||
    { echo "$typed: $(cat missing)" >&2; head -n 40 real.txt >&2; failed=1; }
done
exit $failed
