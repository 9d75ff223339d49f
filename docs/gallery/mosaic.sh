#!/usr/bin/env bash
# Sourced by scripts that make pictures of a show: $show is its name, $domefall the program, $out the
# folder for frames.
#
# mosaic NAME FRAMES COLUMNSxROWS SIZE: 2k frames, made SIZE pixels wide, side by side in one picture.
mosaic() {
  local name=$1 files=() frame picture
  : "${show:?}" "${domefall:?}" "${out:?}"
  "$domefall" render "shows/$show.yaml" --size 2k --frames "$2" --out "$out"
  for frame in ${2//,/ }; do
    printf -v picture '%s/graded/%s_%05d.png' "$out" "$show" "$frame"
    oiiotool "$picture" --ch R,G,B --resize "$4x$4" -o "$out/small_$frame.tif"
    files+=("$out/small_$frame.tif")
  done
  oiiotool "${files[@]}" --mosaic "$3" --compression jpeg:84 -o "docs/gallery/${show}_$name.jpg"
}
