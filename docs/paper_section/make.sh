#!/usr/bin/env bash
# make.sh OUT: runs one experiment and makes a section of a paper of it, OUT/section.pdf: a figure of
# column width, two tables and captions. VITRUVIA names the program, EXPERIMENT another experiment
# file that sweeps the same setting.
set -euo pipefail

here=$(dirname "$(readlink -f "$0")")
vitruvia=${VITRUVIA:-$here/../../build/vitruvia}
experiment=${EXPERIMENT:-$here/../../configs/ablations/pair_cutoff.json}
out=${1:?expected the folder to write to}

mkdir -p "$out"
"$vitruvia" run "$experiment" -o "$out/experiment"
"$vitruvia" report "$out/experiment" --width 84mm --font-size 8 --format pdf
"$vitruvia" compare "$out/experiment" --metric joint_error_mean_m --metric l2_mean_m -o "$out/comparison.tex"
cp "$here/section.tex" "$out/section.tex"
cd "$out"
for pass in 1 2; do  # the second one knows the numbers of figures and tables
  pdflatex -interaction=nonstopmode -halt-on-error section.tex >pdflatex.txt || { tail -n 30 pdflatex.txt >&2; exit 1; }
done
echo "$out/section.pdf"
