#!/usr/bin/env bash
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What the program writes: meshes of every format, cells, samples, the report, the table.
. "$(dirname "${BASH_SOURCE[0]}")/check.bash"

torus >torus.off
fast=(-n 200 --iterations 5 --traits cpu)

# field NAME: the value of the first such field of r.json
field() { sed -n "s/^ *\"$1\": \(.*[^,{[]\),\{0,1\}$/\1/p" r.json | head -n 1; }
# has NAME VALUE: the field has that value
has() { expect "the report's $1 is '$(field "$1")' instead of '$2'" [ "$(field "$1")" = "$2" ]; }

# measured: mean, least and largest length of the edges of out.off, and its largest angle
measured() {
  awk 'BEGIN { n = 0 } NR > 2 && NF == 3 { for (k = 1; k <= 3; ++k) p[n, k] = $k; ++n }
    NR > 2 && NF == 4 {
      for (k = 0; k < 3; ++k) {
        l[k] = 0
        for (i = 1; i <= 3; ++i) l[k] += (p[$(k + 2), i] - p[$((k + 1) % 3 + 2), i]) ^ 2
        sum += sqrt(l[k]); ++count
        if (least == 0 || l[k] < least) least = l[k]
        if (l[k] > most) most = l[k]
      }
      for (k = 0; k < 3; ++k) {
        a = l[k]; b = l[(k + 1) % 3]; c = l[(k + 2) % 3]
        cosine = (a + b - c) / 2 / sqrt(a * b)
        angle = atan2(sqrt(1 - cosine ^ 2), cosine) * 45 / atan2(1, 1)
        if (angle > theta) theta = angle
      }
    }
    END { printf "%.10g %.10g %.10g %.10g", sum / count, sqrt(least), sqrt(most), theta }' out.off
}

# vertices FILE.off: its 200 vertices, rounded
vertices() { grep . "$1" | sed -n 3,202p | rounded; }
rounded() { awk '{ for (k = 1; k <= 3; ++k) printf "%.11f ", $k + 1e-13; print "" }'; }

# --- the report
run 0 -- torus.off out.off "${fast[@]}" --report r.json
for name in vertices faces euler_characteristic input_euler_characteristic components border_edges \
  self_intersections q_min q_avg theta_min theta_min_avg theta_max below_30 above_90 \
  edge_length_mean edge_length_median edge_length_min edge_length_max thin_parts diagonal distance_rms distance_mean distance_max \
  absolute_distance_rms absolute_distance_mean absolute_distance_max not_carried_over \
  inside_capacity_interval capacity_rms constructions outer_iterations \
  cells ok guarded empty incomplete seconds load surface sampling optimization extraction \
  improvement write total traits preset seed threads missed_guarantees; do
  expect "the report has $name" grep -q "\"$name\": ." r.json
done
has vertices 200
has faces 400
has euler_characteristic 0
has input_euler_characteristic 0
has input_vertices 800
has components 1
has border_edges 0
has self_intersections 0
has missed_guarantees '[]'
has not_carried_over '[]'
has traits '"cpu"'
has preset '"quality"'
has seed 0
expect 'the braces of the report match' \
  [ "$(tr -cd '{' <r.json | wc -c)" -eq "$(tr -cd '}' <r.json | wc -c)" ]
expect 'the table shows the vertices' grep -Eq '^ *vertices +200 +800$' stdout
expect 'the table shows the quality' grep -q 'triangle quality' stdout
for row in 'largest angle' 'edge length, mean' 'edge length, least' 'edge length, largest' \
  'distance to the input, mean' 'distance to the input, largest'; do
  expect "the table shows the $row" grep -q "^ *$row  " stdout
done
# by hand from out.off: the lengths of the edges, each twice, and the largest angle
expect "the edges and the largest angle are those of the mesh: $(measured)" \
  awk -v is="$(measured)" -v said="$(for name in edge_length_mean edge_length_min edge_length_max \
    theta_max; do field $name; done | tr '\n' ' ')" 'BEGIN { split(is, a); n = split(said, b)
    for (i = 1; i <= 4; ++i) if (a[i] <= 0 || (a[i] / b[i] - 1) ^ 2 > 1e-10) exit 1
    exit n != 4 }'
# the torus fills 8 x 8 x 2
expect 'the diagonal is that of the input' awk -v d="$(field diagonal)" \
  'BEGIN { exit (d / sqrt(132) - 1) ^ 2 > 1e-6 }'
expect 'the absolute distance is that share of it' awk -v d="$(field diagonal)" \
  -v p="$(field distance_max)" -v a="$(field absolute_distance_max)" \
  'BEGIN { exit !(a > 0 && (a / (p / 100 * d) - 1) ^ 2 < 1e-10) }'
expect 'no progress bar where there is no terminal' [ ! -s stderr ]
expect 'the OFF header counts' [ "$(sed -n 2p out.off)" = '200 400 0' ]

# --- every format, read back: the same mesh
cp out.off first.off
for end in obj ply stl OFF; do
  run 0 -- torus.off "m.$end" "${fast[@]}" --quiet
  expect "--quiet prints nothing" [ ! -s stdout ]
  expect "--quiet prints nothing on stderr" [ ! -s stderr ]
  run 0 -- "m.$end" again.off -n 50 --iterations 2 --report r.json
  has input_vertices 200
  has input_faces 400
  has input_euler_characteristic 0
done
expect 'OFF and .OFF are the same' cmp first.off m.OFF
expect 'PLY is binary' grep -aq '^format binary_little_endian 1.0$' m.ply
expect 'STL is binary' [ "$(wc -c <m.stl)" -eq $((84 + 50 * 400)) ]
for end in ply stl; do
  run 0 -- torus.off "t.$end" "${fast[@]}" --ascii --quiet
  run 0 -- "t.$end" again.off -n 50 --iterations 2 --report r.json
  has input_vertices 200
  has input_faces 400
done
expect '--ascii writes PLY as text' [ "$(sed -n 2p t.ply)" = 'format ascii 1.0' ]
expect '--ascii writes STL as text' [ "$(tail -n 1 t.stl)" = endsolid ]
# the coordinates that binary PLY and text hold are the same: so is what is made of them
for end in ply off; do
  run 0 -- "$([ $end = ply ] && echo m.ply || echo first.off)" "from_$end.off" -n 100 --iterations 2
done
run 0 -- t.ply from_text.off -n 100 --iterations 2
expect 'binary PLY holds the coordinates of the OFF' cmp from_ply.off from_off.off
expect 'text PLY holds the coordinates of the OFF' cmp from_text.off from_off.off
expect 'an OBJ has the vertices of the OFF' cmp \
  <(sed -n 's/^v //p' m.obj | rounded) <(vertices first.off)
run 0 -- torus.off m.vtp "${fast[@]}" --quiet
expect 'a VTP counts its points and polygons' grep -q 'NumberOfPoints="200".*NumberOfPolys="400"' m.vtp
expect 'a VTP is complete' grep -q '^</VTKFile>$' m.vtp
expect 'a VTP has 200 points' [ "$(awk '/<Points>/ { on = 1; next } /<\/Points>/ { on = 0 }
                                        on && NF == 3 && !/</' m.vtp | wc -l)" -eq 200 ]
run 0 -- torus.off m.vtu "${fast[@]}" --quiet
expect 'a VTU counts its points and cells' grep -q 'NumberOfPoints="200" NumberOfCells="400"' m.vtu
expect 'a VTU has the points and triangles of a VTP' cmp \
  <(sed -n '/"Points"/,/<.Points>/p; /"connectivity"/,/<.DataArray>/p' m.vtu) \
  <(sed -n '/"Points"/,/<.Points>/p; /<Polys>/,/<.DataArray>/p' m.vtp | grep -v '<Polys>')
run 0 -- torus.off m.msh "${fast[@]}" --quiet
# section NAME: its lines, without the number at the beginning
section() { sed -n "/^.$1\$/,/^.End$1\$/p" m.msh | sed '1,2d; $d' | cut -d ' ' -f 2-; }
expect 'an MSH has the vertices of the OFF' cmp \
  <(section Nodes | rounded) <(vertices first.off)
expect 'an MSH has 400 triangles in one group' [ "$(section Elements | grep -c '^2 2 1 1 ')" -eq 400 ]

# --- cells and samples
for end in ply vtp; do
  run 0 -- torus.off out.off "${fast[@]}" --improvement no --cells "c.$end" \
    --samples-out "s.$end" --ascii --quiet
  for name in weight mass density status sample; do
    expect "the cells' .$end has $name" grep -qE "(property (int|double) $name|Name=\"$name\")" "c.$end"
  done
  for name in weight density; do
    expect "the samples' .$end has $name" grep -qE "(property double $name|Name=\"$name\")" "s.$end"
  done
done
expect 'there are 200 cells' grep -q '^element face 200$' c.ply
expect 'there are 200 cells' grep -q 'NumberOfPolys="200"' c.vtp
expect 'there are 200 samples' grep -q '^element vertex 200$' s.ply
expect 'there are 200 samples' grep -q 'NumberOfPoints="200" NumberOfVerts="200"' s.vtp
expect 'the normals have length 1' awk '/end_header/ { on = 1; next }
  on && ($4 * $4 + $5 * $5 + $6 * $6 - 1) ^ 2 > 1e-12 { bad = 1 } END { exit bad }' s.ply
expect 'the samples are the vertices' cmp \
  <(sed '1,/end_header/d' s.ply | rounded) <(vertices out.off)
expect 'there are samples to compare' [ "$(sed '1,/end_header/d' s.ply | wc -l)" -eq 200 ]
# the masses are those of the input's units: their sum is near the torus's area, 4 pi^2 * 3
run 0 -- torus.off --no-mesh "${fast[@]}" --density uniform --cells c.ply --ascii --quiet
expect 'the masses of uniform cells add up to the area' awk '/end_header/ { on = 1; next }
  on && $1 > 2 && NF == $1 + 6 { sum += $($1 + 4); ++n }
  END { exit !(n == 200 && sum > 110 && sum < 125) }' c.ply
run 0 -- torus.off --no-mesh "${fast[@]}" --density uniform --cells b.ply --samples-out s.ply --quiet
expect 'the cells are binary' [ "$(sed -n 2p b.ply)" = 'format binary_little_endian 1.0' ]
expect 'the samples are binary' [ "$(sed -n 2p s.ply)" = 'format binary_little_endian 1.0' ]
# a header; a sample has 3 + 3 + 2 doubles
expect 'binary samples have their size' \
  [ "$(sed '1,/end_header/d' s.ply | wc -c)" -eq $((200 * 8 * 8)) ]
# a cell's vertex has 3 doubles; a cell a byte, its corners, 3 doubles and 2 integers
corners=$(sed '1,/end_header/d' c.ply | awk 'NF > 3 { sum += $1 } END { print sum }')
expect 'binary cells have their size' \
  [ "$(sed '1,/end_header/d' b.ply | wc -c)" -eq $((corners * (24 + 4) + 200 * (1 + 24 + 8))) ]
cube >cube.off
for traits in cpu exact; do
  run 0 -- cube.off out.off -n 8 --traits $traits --cells c.ply --html page.html --check --ascii
  expect "corners alone have no cells ($traits)" grep -q '^element vertex 0$' c.ply
  expect "the page has them, too ($traits)" grep -q '"cells":{"points":"","sides":""}' page.html
done
echo untouched >out.off
run 0 -- torus.off out.off --no-mesh "${fast[@]}" --samples-out s.ply --report r.json
expect '--no-mesh leaves the output' [ "$(cat out.off)" = untouched ]
expect '--no-mesh says nothing about a mesh' [ -z "$(field q_min)" ]
expect '--no-mesh reports the cells' [ -n "$(field inside_capacity_interval)" ]

# --- the fields of the lattice, for a torus around (100, 0, 0): 6 nodes per sample, each a line
awk 'NR > 2 && NF == 3 { printf "%.17g %s %s\n", $1 + 100, $2, $3; next } 1' torus.off >far.off
run 0 -- far.off plain.off "${fast[@]}" --quiet
run 0 -- far.off out.off "${fast[@]}" --fields f.vtp --quiet
expect 'the fields do not change the mesh' cmp out.off plain.off
if command -v python3 >/dev/null; then
  expect 'the fields are XML' python3 -c 'import xml.dom.minidom as x; x.parse("f.vtp")'
else
  echo 'skipped: whether the fields are XML (there is no python3)'
fi
piece() { sed -n "s/.* $1=\"\([0-9]*\)\".*/\1/p" f.vtp | head -n 1; }
# array NAME: its rows
array() { sed -n "/Name=\"$1\"/,/<.DataArray>/p" f.vtp | sed '1d; $d'; }
dots=$(piece NumberOfVerts)
expect 'there are 800 nodes' [ "$(piece NumberOfLines)" = 800 ]
expect "there are about as many points as samples, not $dots" [ "$dots" -gt 180 -a "$dots" -lt 280 ]
expect 'a point has one point, a line two' [ "$(piece NumberOfPoints)" -eq $((dots + 1600)) ]
expect 'all points are there' [ "$(array Points | wc -l)" -eq $((dots + 1600)) ]
for name in node is_point normal axis spacing index dislocation; do
  expect "each has its $name" [ "$(array $name | wc -l)" -eq $((dots + 800)) ]
done
expect 'the first are points' [ "$(array is_point | grep -c 1)" = "$dots" ]
expect 'the points are on the torus' awk -v n="$dots" 'NR <= n {
  d = sqrt((sqrt(($1 - 100) ^ 2 + $2 ^ 2) - 3) ^ 2 + $3 ^ 2); if (d < 0.9 || d > 1.01) bad = 1 }
  END { exit bad }' <(array Points)
expect 'lines have half the length of the spacing' awk -v n="$dots" '
  NR == FNR { h[FNR] = $1; next }
  FNR > n { k = FNR - n - 1
    if (k % 2) { l = sqrt(($1 - x) ^ 2 + ($2 - y) ^ 2 + ($3 - z) ^ 2) / h[n + (k + 1) / 2]
      if (l < 0.499 || l > 0.501) bad = 1 }
    x = $1; y = $2; z = $3 } END { exit bad }' <(array spacing) <(array Points)
run 0 -- far.off --no-mesh "${fast[@]}" --fields again.vtp --threads 1 --quiet
expect 'the fields are the same without the mesh, by one thread' cmp again.vtp f.vtp

# --- the same seed, the same output, whatever the number of threads
for threads in 1 2 0; do
  run 0 -- torus.off out.off "${fast[@]}" --threads $threads --quiet
  expect "$threads threads make the same mesh" cmp out.off first.off
done
run 0 -- torus.off out.off "${fast[@]}" --seed 1 --quiet
expect 'another seed makes another mesh' [ "$(cksum <out.off)" != "$(cksum <first.off)" ]

# --- too few vertices for the topology
run 1 'torus.off' 'at least 7' -- torus.off out.off -n 4

# --- a guarantee that cannot be met: the input intersects itself. The mesh is written all the same.
printf '%s\n' OFF '8 8 0' '0 0 0' '1 0 0' '0 1 0' '0 0 1' '.2 .2 .2' '1.2 .2 .2' '.2 1.2 .2' \
  '.2 .2 1.2' '3 0 2 1' '3 0 1 3' '3 0 3 2' '3 1 2 3' '3 4 6 5' '3 4 5 7' '3 4 7 6' '3 5 6 7' \
  >crossing.off
run 3 'out.off' 'guarantee' -- crossing.off out.off -n 60 --report r.json
expect 'a mesh that misses a guarantee is written' grep -q OFF out.off
expect 'the report names the guarantee' [ "$(field missed_guarantees)" != '[]' ]

# --- angles that are asked for
run 0 -- torus.off out.off "${fast[@]}" --min-angle 10 --max-angle 150
run 3 'out.off' 'smallest angle: ' 'instead of 59.5' -- torus.off out.off "${fast[@]}" \
  --min-angle 59.5 --report r.json
expect 'the report names the angle' [ "$(field missed_guarantees)" != '[]' ]
run 3 'largest angle: ' 'instead of 61' -- torus.off out.off "${fast[@]}" --max-angle 61

# --- edge lengths that are wanted: by a property, by a file
awk 'NR > 2 && NF == 3 { printf "%.17g\n", .3 + .05 * $1 }' torus.off >lengths.txt
{
  printf '%s\n' ply 'format ascii 1.0' 'element vertex 800' 'property double x' 'property double y' \
    'property double z' 'property double h' 'element face 1600' \
    'property list uchar int vertex_indices' end_header
  awk 'NR > 2 && NF == 3' torus.off | paste -d ' ' - lengths.txt
  awk 'NR > 2 && NF == 4' torus.off
} >lengths.ply
run 0 -- lengths.ply by_property.off --size-field h --report r.json
expect 'the lengths give the number' [ "$(field samples)" -gt 500 ]
run 0 -- torus.off by_file.off --size-field lengths.txt
expect 'a file gives the same' cmp by_property.off by_file.off
run 0 -- torus.off out.off "${fast[@]}" --size-field lengths.txt --report r.json
has vertices 200
run 0 -- torus.off out.off "${fast[@]}" --density-field lengths.txt
run 0 -- torus.off out.off --edge-length .5 --refine sphere:4,0,0,.5,.1 --report r.json
more=$(field samples)
run 0 -- torus.off out.off --edge-length .5 --refine sphere:4,0,0,.5,.1 --refine box:-5,-1,-1,-3,1,1,.2 \
  --report r.json
expect 'the report names the regions' grep -q '^      "box:-5,-1,-1,-3,1,1,.2"' r.json
expect 'each region adds samples' [ "$(field samples)" -gt "$more" ]
run 0 -- torus.off out.off -n 800 --min-edge-length .2 --max-edge-length 1
run 1 'torus.off' 'need at least' -- torus.off out.off -n 800 --max-edge-length .01
run 1 'lengths.ply' 'no property k' 'they have h' -- lengths.ply out.off --size-field k
run 1 'torus.off' 'no property k' 'they have none' -- torus.off out.off --size-field k
head -n 7 lengths.txt >few.txt
run 1 'few.txt has 7 numbers' '800 vertices' -- torus.off out.off --size-field few.txt
sed 3s/.*/x/ lengths.txt >letters.txt
run 1 "letters.txt: line 3: 'x' is not a number" -- torus.off out.off --size-field letters.txt
sed 3s/.*/0/ lengths.txt >zero.txt
run 1 'zero.txt: the value of vertex 2' 'positive' -- torus.off out.off --size-field zero.txt
awk '{ print $1, 1 }' lengths.txt >pairs.txt
run 1 "pairs.txt: line 1: '1' is more than" -- torus.off out.off --size-field pairs.txt

# --- labels: the halves y < 0 and y > 0; their areas
awk 'NR > 2 && NF == 3 { y[n++] = $2 } NR > 2 && NF == 4 { print $0, (y[$2] + y[$3] + y[$4] > 0) + 5 }' \
  torus.off >labeled_facets.txt
{
  printf '%s\n' ply 'format ascii 1.0' 'element vertex 800' 'property double x' 'property double y' \
    'property double z' 'element face 1600' 'property list uchar int vertex_indices' \
    'property int half' end_header
  awk 'NR > 2 && NF == 3' torus.off
  cat labeled_facets.txt
} >labels.ply
# faces FILE.ply: how many faces have each of the numbers at the ends of their lines
faces() { awk '$1 == 3 && NF == 5 { ++n[$5] } END { for (k in n) print k, n[k] }' "$1" | sort; }
run 0 -- labels.ply out.ply -n 400 --labels half --ascii --report r.json
has crease_edges 40
has labels '"half"'
expect 'both labels come out' [ "$(faces out.ply | cut -d ' ' -f 1 | paste -sd ' ')" = '5 6' ]
run 0 -- labels.ply plain.ply -n 400 --ascii --report r.json
has crease_edges 0
run 0 -- labels.ply out.ply -n 400 --labels half --patches --ascii
expect 'patches are numbered' grep -q '^property int patch' out.ply
run 0 -- labels.ply out.msh -n 400 --labels half --patches
expect 'labels are physical groups' [ "$(grep '^2 [0-9]* "half' out.msh | paste -sd ' ')" = \
  '2 5 "half 5" 2 6 "half 6"' ]
expect 'all triangles are in one of them' \
  [ "$(awk '/^.EndElements/ { on = 0 } on && NF == 8 { print $4 } /^.Elements/ { on = 1 }' out.msh |
    sort -u | paste -sd ' ')" = '5 6' ]
expect 'patches are values' grep -q '^"patch"$' out.msh
run 5 'out.off' '.vtu and .msh hold' -- labels.ply out.off -n 400 --patches
run 1 'no property third' 'they have half' -- labels.ply out.off --labels third
sed 's/^\(3 .*\) 5$/\1 5.5/; s/int half/double half/' labels.ply >fractions.ply
run 1 'its property half' 'no whole number' -- fractions.ply out.off --labels half
{
  off_to_obj <torus.off | grep '^v'
  awk '$5 != last { print "usemtl m" $5; last = $5 } { print "f", $2 + 1, $3 + 1, $4 + 1 }' \
    labeled_facets.txt
} >labels.obj
run 0 -- labels.obj out.obj -n 400 --labels material --report r.json
has crease_edges 40
expect 'materials come out' [ "$(grep usemtl out.obj | sort -u | paste -sd ' ')" = 'usemtl m5 usemtl m6' ]
run 0 'labels.obj: not carried over to the output: materials' -- labels.obj out.obj -n 400 --report r.json
has crease_edges 0
run 0 'names of materials' -- labels.obj out.ply -n 400 --labels material
{
  cat labels.obj
  echo l 1 2 3 4
} >lines.obj
run 0 -- lines.obj out.obj -n 400 --lines --report r.json
has crease_edges 3
run 0 'not carried over to the output: lines, materials' -- lines.obj out.obj -n 400
run 0 -- lines.obj by_lines.off -n 400 --lines
printf '0 1\n1 2\n3 2\n' >pairs.txt
run 0 -- torus.off by_pairs.off -n 400 --creases pairs.txt --report r.json
has crease_edges 3
expect 'pairs of vertices do as lines' cmp by_pairs.off by_lines.off
expect 'the report names them' grep -q '"creases": "pairs.txt"' r.json
awk 'NR == 2 { print "ply\nformat ascii 1.0\nelement vertex " $1 "\nproperty double x\nproperty double y"
       print "property double z\nelement face " $2 "\nproperty list uchar int vertex_indices"
       print "element edge 3\nproperty int vertex1\nproperty int vertex2\nend_header" }
     NR > 2' torus.off >edges.ply
cat pairs.txt >>edges.ply
run 0 -- edges.ply by_edges.off -n 400 --lines
expect 'edges of PLY do as lines' cmp by_edges.off by_lines.off
run 0 'not carried over to the output: lines' -- edges.ply out.off -n 400
echo 5 >>pairs.txt
run 1 'pairs.txt: line 4: it has one number only' -- torus.off out.off -n 400 --creases pairs.txt
echo 0 1 2 >pairs.txt
run 1 "pairs.txt: line 1: '2' is more than belongs into a line" -- torus.off out.off -n 400 --creases pairs.txt
echo 0 11 >pairs.txt
run 1 'pairs.txt: the edge from vertex 0 to 11 (numbered from 0) runs along no edge' -- \
  torus.off out.off -n 400 --creases pairs.txt
run 1 'none.txt cannot be read' -- torus.off out.off -n 400 --creases none.txt
sed '$ a l 1 12' labels.obj >wrong.obj
run 1 'its line from vertex 0 to 11 (numbered from 0) runs along no edge' -- wrong.obj out.obj -n 400 --lines

# --- input that is repaired
sed '$ a 3 0 0 1' torus.off | sed '2s/800 1600 0/800 1601 0/' >degenerate.off
run 0 -- degenerate.off out.off "${fast[@]}" --report r.json
has degenerate_facets 1
sed '2s/800/801/; 802 a 9 9 9' torus.off >unused.off
run 0 -- unused.off out.off "${fast[@]}" --report r.json
has unused_vertices 1
awk 'NR == 2 { print 800, 800, 0; next } NR > 802 && NR % 2 { a = $2; c = $3; d = $4; next }
     NR > 802 { print 4, a, c, d, $4; next } { print }' torus.off >quads.off
run 0 -- quads.off out.off "${fast[@]}" --report r.json
has triangulated_polygons 800
has input_euler_characteristic 0

# --- input that intersects itself
run 0 -- crossing.off out.off -n 200 --intersections resolve --report r.json
has self_intersections 0
expect 'the report counts what was resolved' [ "$(field resolved_pairs)" -gt 0 ]
run 0 -- crossing.off out.off -n 500 --density uniform --intersections wrap --wrap-radius 0.3 --report r.json
has self_intersections 0
has border_edges 0
has wrap_radius 0.3
has wrap_offset 0.01

# --- what the output has not
off_to_obj <torus.off | sed '1i mtllib a.mtl' | sed '$ a vt 0 0\nusemtl m' >textured.obj
run 0 'textured.obj: not carried over to the output: materials, texture coordinates' -- \
  textured.obj out.off "${fast[@]}" --report r.json
expect 'it is said once' [ "$(grep -c 'not carried over' stderr)" -eq 1 ]
expect 'the report lists it' grep -q '^    "materials",$' r.json
run 0 -- textured.obj out.off "${fast[@]}" --quiet --report r.json
expect '--quiet does not say it' [ ! -s stderr ]
expect 'the report lists it nevertheless' grep -q '^    "texture coordinates"$' r.json
awk '/^v / { print; print "vt", $2, $3 } /^f / { print "f", $2 "/" $2, $3 "/" $3, $4 "/" $4 }' textured.obj |
  sed '1i mtllib a.mtl' >uv.obj
run 0 'not carried over to the output: texture coordinates' -- uv.obj out.vtp "${fast[@]}" --texture
run 0 'not carried over to the output: texture coordinates' -- uv.obj out.ply "${fast[@]}"
run 0 -- uv.obj out.obj "${fast[@]}" --texture --report r.json
has not_carried_over '[]'
has texture true
expect 'every vertex has texture coordinates' [ "$(grep -c '^vt ' out.obj)" = 200 ]
for format in glb gltf ply; do
  run 0 -- uv.obj "uv.$format" "${fast[@]}" --texture
  run 0 -- "uv.$format" out.obj "${fast[@]}" --texture
  expect "texture coordinates go through $format" [ "$(grep -c '^vt ' out.obj)" = 200 ]
done
sed '2a comment TextureFile a b.png' <(run 0 -- uv.obj uv.ply "${fast[@]}" --texture --ascii; cat uv.ply) >one.ply
mkdir -p folder
run 0 -- one.ply folder/out.obj "${fast[@]}" --texture
expect 'a texture of a PLY file is in the materials of OBJ' grep -qx 'map_Kd ../a b.png' folder/out.mtl
expect 'which the OBJ file names' grep -qx 'mtllib out.mtl' folder/out.obj
run 0 -- one.ply folder/out.ply "${fast[@]}" --texture --ascii
expect 'and from PLY to PLY, as seen from there' grep -qx 'comment TextureFile ../a b.png' folder/out.ply
expect 'with its number' grep -qx 'property int texnumber' folder/out.ply
rm -r folder/out.mtl
mkdir folder/out.mtl
echo untouched >folder/out.obj
run 5 'out.mtl: cannot be written' -- one.ply folder/out.obj "${fast[@]}" --texture
expect 'without the materials nothing is written' [ "$(cat folder/out.obj)" = untouched ]
run 0 -- torus.off torus.vtp -n 300 --iterations 5 --traits cpu --patches
run 0 -- torus.vtp out.vtp "${fast[@]}" --labels patch --report r.json
has input_vertices 300
expect 'labels go from VTP to VTP' grep -q 'Name="patch"' out.vtp
sed -i 's/^vt .*/vt 0 x/' uv.obj
run 1 'its texture coordinates cannot be used: line' -- uv.obj out.off "${fast[@]}" --texture
run 0 -- uv.obj out.off "${fast[@]}"

# --- what the output has of the input: a torus whose colors and heights are linear functions of z
off_to_ply <torus.off | awk '
  /^property double z/ { print; print "property uchar red\nproperty uchar green\nproperty uchar blue"
                         print "property float height"; next }
  /^property list/ { print; print "property int side"; next }
  /^end_header/ { on = 1; print; next }
  on && NF == 3 { z[n++] = $3; r = int(127.5 * (1 + $3) + .5); print $0, r, 255 - r, 7, 2 * $3 + 5; next }
  on && NF == 4 { print $0, (z[$2] + z[$3] + z[$4] > 0) ? 3 : 8; next } 1' >colored.ply
run 0 -- colored.ply out.ply "${fast[@]}" --improvement no --ascii --quiet --report r.json
has not_carried_over '[]'
expect 'values of vertices on the surface are linear, up to rounding' awk '/end_header/ { on = 1; next }
  on && NF == 7 { ++n; r = 127.5 * (1 + $3)
    if (($4 - r) ^ 2 > 1.1 || ($4 + $5 - 255) ^ 2 > 1 || $6 != 7 || ($7 - 2 * $3 - 5) ^ 2 > 1e-10) bad = 1 } # six digits in
  END { exit bad || n != 200 }' out.ply
expect 'faces have the label of their side' awk '/end_header/ { on = 1; next }
  on && NF == 7 { z[n++] = $3 }
  on && NF == 5 { s = z[$2] + z[$3] + z[$4]; if (s * s > 1e-2 && $5 != (s > 0 ? 3 : 8)) bad = 1; ++f }
  END { exit bad || f != 400 }' out.ply
run 0 -- colored.ply plain.ply "${fast[@]}" --improvement no --ascii --quiet --threads 1
expect 'the values are the same by one thread' cmp plain.ply out.ply
run 0 -- colored.ply out.vtp "${fast[@]}" --quiet
expect 'VTP has the labels' grep -q '<DataArray type="Int32" Name="side"' out.vtp
run 0 'not carried over to the output: facet property side, vertex property height' -- \
  colored.ply out.obj "${fast[@]}"
expect 'OBJ has the colors' awk '$1 == "v" { ++n; if (NF != 7 || ($5 + $6 - 1) ^ 2 > 1e-4) bad = 1 }
  END { exit bad || n != 200 }' out.obj
run 0 'not carried over to the output: colors, facet property side, vertex property height' -- \
  colored.ply out.off "${fast[@]}"
expect 'what the input has beside does not change the mesh' cmp out.off first.off

run 0 -- torus.off out.off "${fast[@]}" --provenance p.ply --ascii --quiet
expect 'the provenance does not change the mesh' cmp out.off first.off
expect 'vertices are near the places that they come from' awk '
  FNR == NR { if (NF == 3 && FNR > 2) for (k = 1; k <= 3; ++k) p[i + 0, k] = $k
              if (NF == 3 && FNR > 2) ++i
              if (NF == 4) { for (k = 2; k <= 4; ++k) face[f + 0] = face[f + 0] " " $k " "; ++f } next }
  /end_header/ { on = 1; next }
  on && NF == 10 { ++n
    for (k = 5; k <= 7; ++k) if (index(face[$4], " " $k " ") == 0) bad = 1
    for (k = 1; k <= 3; ++k) {
      x = $8 * p[$5, k] + $9 * p[$6, k] + $10 * p[$7, k]; if ((x - $k) ^ 2 > 1e-2) bad = 1 } }
  END { exit bad || n != 200 }' torus.off p.ply
run 2 '--provenance' -- torus.off --no-mesh --provenance p.ply
run 5 'p.obj' -- torus.off out.off --provenance p.obj

# --- places to write to
cp torus.off same.off
run 0 -- same.off same.off "${fast[@]}" --quiet
expect 'the input may be the output' cmp same.off first.off
echo old >target.off && ln -s target.off link.off
run 0 -- torus.off link.off "${fast[@]}" --quiet
expect 'a symbolic link stays one' [ -L link.off ]
expect 'its target is written' cmp target.off first.off
ln -s new.off dangling.off
run 0 -- torus.off dangling.off "${fast[@]}" --quiet
expect 'a symbolic link to nothing yet stays one' [ -L dangling.off ]
expect 'its target is made' cmp new.off first.off
mkdir sub && ln -s ../chain.off sub/link.off && ln -s sub/link.off chain_link.off
run 0 -- torus.off chain_link.off "${fast[@]}" --quiet
expect 'a chain of links is followed' cmp chain.off first.off
expect 'its links stay' [ -L chain_link.off -a -L sub/link.off ]
ln -s later.off other_link.off
run 2 'same file' -- torus.off other_link.off --report later.off
chmod 640 target.off
run 0 -- torus.off target.off "${fast[@]}" --quiet
expect 'the mode of a replaced file stays' [ "$(stat -c %a target.off)" = 640 ]
run 0 -- torus.off out.off "${fast[@]}" --quiet --report /dev/stdout
expect 'a report may go to a file that is open' grep -q '"vertices": 200' stdout
# reported FILE: what is written there where standard output is a pipe
reported() { "$program" torus.off out.off "${fast[@]}" --quiet --report "$1" | cat; }
expect 'a report may go to a pipe' [ "$(reported /dev/stdout | grep -c '"vertices": 200')" = 1 ]
mkfifo pipe
cat pipe >read &
expect 'a report may go to a named pipe' reported pipe
wait
expect 'all of it is read' [ "$(tail -n 1 read)" = '}' -a -p pipe ]
expect 'a report may go to a device' [ -z "$(reported /dev/null)" -a -c /dev/null ]
exec 7<>unnamed && rm unnamed
reported /dev/fd/7
expect 'a report may go to a file without a name' grep -q '"vertices": 200' <&7
exec 7>&-
name='a name with  blanks, and ünïcödë.off'
cp torus.off "$name"
run 0 -- "$name" "new $name" "${fast[@]}" --report r.json
expect 'any name will do' cmp "new $name" first.off
expect 'no temporary files are left' [ -z "$(find . -name '.power_rtf_*')" ]

# --- the progress bar
if ! script -qec true /dev/null >/dev/null 2>&1 </dev/null; then
  echo 'skipped: the progress bar (no pseudo-terminal can be had here)'
else
  script -qec "'$program' torus.off out.off -n 200 --iterations 50 \
    --centroid-tolerance 0" terminal >/dev/null </dev/null
  expect 'a terminal shows progress' grep -q '#####.*%' terminal
  script -qec "'$program' torus.off out.off -n 200 --quiet" terminal >/dev/null </dev/null
  expect '--quiet shows no progress' [ "$(grep -c '#####' terminal)" -eq 0 ]
fi

finish
