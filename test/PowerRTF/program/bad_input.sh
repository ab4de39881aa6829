#!/usr/bin/env bash
# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Input that cannot be used: a message that names file and reason, exit code 1, the output untouched.
# Outputs that cannot be written: the same with exit code 5.
. "$(dirname "${BASH_SOURCE[0]}")/check.bash"

# bad FILE REASON...: as above
bad() {
  local file=$1
  shift
  run 1 "$file" "$@" -- "$file" out.off -n 100 --iterations 2 --relaxation-iterations 2
}

torus >torus.off
off_to_obj <torus.off >torus.obj
off_to_ply <torus.off >torus.ply
off_to_stl <torus.off >torus.stl
for f in torus.{off,obj,ply,stl}; do run 0 -- "$f" good.off -n 100 --iterations 2 --quiet; done

# --- no mesh at all
bad missing.off 'no such file'
mkdir folder.off && bad folder.off 'is a directory'
for end in off obj ply stl; do
  : >"empty.$end" && bad "empty.$end" 'is empty'
  echo 'Dear Sir or Madam, this is a letter.' >"letter.$end" && bad "letter.$end" 'not a'
  printf '\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x01\0\0\0\x01\x08\x02\0\0\0\x90wS\xde' >"png.$end"
  bad "png.$end" 'a PNG image'
  head -c 20000 "$program" >"program.$end" && bad "program.$end" 'a program'
  tail -c 20000 "$program" >"binary.$end" && bad "binary.$end" 'not a'
  printf '\x1f\x8b\x08\0\0\0\0\0' >"gzip.$end" && bad "gzip.$end" 'a gzip archive: unpack it first'
  printf 'PK\3\4\24\0\0\0\x08\0' >"zip.$end" && bad "zip.$end" 'a zip archive: unpack it first'
  printf '\xff\xfeO\0F\0F\0\n\0' >"utf16.$end" && bad "utf16.$end" 'UTF-16'
  printf '\n <!DOCTYPE HTML>\n<html>404</html>\n' >"page.$end" && bad "page.$end" 'an HTML page'
  printf 'version https://git-lfs.github.com/spec/v1\noid sha256:00\n' >"lfs.$end"
  bad "lfs.$end" 'Git LFS'
  printf '\n\n   \n' >"blank.$end" && bad "blank.$end"
done
cp torus.off torus.xyz && bad torus.xyz 'does not end in'
cp torus.off torus && bad torus 'does not end in'
cp torus.off torus.vtp && bad torus.vtp 'does not end in'
cp gzip.off torus.off.gz && bad torus.off.gz 'a gzip archive'
for is in off ply stl; do
  for named in off obj ply stl; do
    [ "$is" = "$named" ] && continue
    cp "torus.$is" "other.$named" && bad "other.$named" "does not end in .$is"
  done
done

# --- truncated: in the header, in the vertices, in the facets
head -c 3 torus.off >t1.off && bad t1.off 'truncated'
printf 'OFF\n800' >t2.off && bad t2.off 'truncated'
head -n 100 torus.off >t3.off && bad t3.off 'truncated' 'vert'
head -n 2000 torus.off >t4.off && bad t4.off 'truncated' 'facet'
head -n 100 torus.obj >t1.obj && bad t1.obj 'no facets'
head -n 1000 torus.obj | head -c -6 >t2.obj && bad t2.obj 'truncated'
head -n 3 torus.ply >t1.ply && bad t1.ply 'truncated' 'header'
head -n 100 torus.ply >t2.ply && bad t2.ply 'truncated'
head -n 1000 torus.ply >t3.ply && bad t3.ply 'truncated'
head -n 5 torus.stl >t1.stl && bad t1.stl 'truncated'
head -n 502 torus.stl >t2.stl && bad t2.stl 'truncated'
{ head -c 80 /dev/zero; printf '\x64\0\0\0'; head -c 1000 /dev/zero; } >t3.stl
bad t3.stl 'truncated' '100 facets'
head -c 50 /dev/zero >t4.stl && bad t4.stl 'truncated'

# --- counts that cannot be
printf 'OFF\n1000000000000 2000000000000 0\n0 0 0\n' >c1.off && bad c1.off 'truncated'
printf 'OFF\n-4 4 0\n0 0 0\n' >c2.off && bad c2.off "'-4'"
printf 'OFF\n4 x 0\n0 0 0\n' >c3.off && bad c3.off "'x'"
sed 's/element vertex .*/element vertex 900000000000/' torus.ply >c1.ply && bad c1.ply 'truncated'
sed 's/element face .*/element face -1/' torus.ply >c2.ply && bad c2.ply 'number of elements'
sed 's/property double x/property double u/' torus.ply >c3.ply && bad c3.ply 'no coordinates'
sed 's/uchar int vertex_indices/uchar float vertex_indices/' torus.ply >c4.ply
bad c4.ply 'line 8' "'vertex_indices' is no list of whole numbers"
sed '2a property float x' torus.ply >c5.ply && bad c5.ply 'line 3' 'before the first element'
{ printf 'ply\nformat binary_little_endian 1.0\nelement vertex 3\n'
  printf 'property float %s\n' x y z
  printf 'element face 1\nproperty list uint int vertex_indices\nend_header\n'
  head -c 36 /dev/zero; printf '\x00\x65\xcd\x1d'; head -c 12 /dev/zero; } >c6.ply
bad c6.ply 'truncated' 'face 1 of 1' # its list has 5e8 entries

# --- coordinates
for x in nan NaN -nan inf -inf 1e400 abc; do
  sed "10s/^[^ ]*/$x/" torus.off >x.off && bad x.off 'line 10' "'$x'"
  sed "10s/^v [^ ]*/v $x/" torus.obj >x.obj && bad x.obj 'line 10' "'$x'"
  sed "10s/^[^ ]*/$x/" torus.ply >x.ply && bad x.ply 'line 10' "'$x'"
  sed "11s/^vertex [^ ]*/vertex $x/" torus.stl >x.stl && bad x.stl "'$x'"
done
{ head -c 80 /dev/zero; printf '\x01\0\0\0'; head -c 12 /dev/zero; printf '\0\0\xc0\x7f'
  head -c 34 /dev/zero; } >nan.stl
bad nan.stl 'not finite'

# --- indices
sed '900s/.*/3 0 1 800/' torus.off >i1.off && bad i1.off 'line 900' 'out of range'
sed '900s/.*/3 0 1 -1/' torus.off >i2.off && bad i2.off 'out of range'
sed '900s/.*/3 0 1 99999999999999999999/' torus.off >i3.off && bad i3.off 'out of range'
sed '900s/.*/3 0 1 1.5/' torus.off >i4.off && bad i4.off
sed '900s/.*/f 1 2 801/' torus.obj >i1.obj && bad i1.obj 'out of range'
sed '900s/.*/f 1 2 -801/' torus.obj >i2.obj && bad i2.obj 'out of range'
sed '2400s/.*/f 1 2 0/' torus.obj >i3.obj && bad i3.obj 'out of range'
sed '900s/.*/f 1 2 x/' torus.obj >i4.obj && bad i4.obj
sed '900s/.*/3 0 1 800/' torus.ply >i1.ply && bad i1.ply 'out of range'
sed '900s/.*/3 0 1 -1/' torus.ply >i2.ply && bad i2.ply 'out of range'

# --- no surface
printf 'OFF\n4 0 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n' >n1.off && bad n1.off 'facet'
grep '^v ' torus.obj >n1.obj && bad n1.obj 'no facets'
printf 'solid s\nendsolid s\n' >n1.stl && bad n1.stl 'no facets'
head -c 84 /dev/zero >n2.stl && bad n2.stl 'no facets'
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n' >z1.off && bad z1.off 'area'
printf 'OFF\n3 1 0\n5 5 5\n5 5 5\n5 5 5\n3 0 1 2\n' >z2.off && bad z2.off 'area'
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 1\n' >z3.off && bad z3.off

# --- not a 2-manifold: three facets at an edge; two tetrahedra that share a vertex; a Moebius strip
printf 'OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 1 4\n' >m1.off
run 1 m1.off 'manifold' 'non_manifold = keep' -- m1.off out.off -n 100 --non-manifold split
run 1 m1.off 'manifold' -- m1.off out.off -n 100 --non-manifold refuse
run 0 -- m1.off good.off -n 100 --non-manifold keep
printf 'OFF\n7 8 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n-1 0 0\n0 -1 0\n0 0 -1\n' >m2.off
printf '3 %s\n' '0 2 1' '0 1 3' '0 3 2' '1 2 3' '0 4 5' '0 6 4' '0 5 6' '4 6 5' >>m2.off
run 1 m2.off 'manifold' -- m2.off out.off -n 100 --repair no
run 0 -- m2.off good.off -n 100
run 3 '(the input has' 'option intersections' -- m2.off good.off -n 100 --non-manifold split # they touch
awk 'BEGIN { pi = atan2(0, -1); n = 12; print "OFF"; print 2 * n, 2 * n, 0
  for (i = 0; i < n; ++i) for (s = -1; s <= 1; s += 2) { u = 2 * pi * i / n; r = 2 + s * cos(u / 2)
    print r * cos(u), r * sin(u), s * sin(u / 2) }
  for (i = 0; i < n; ++i) { a = 2 * i; b = 2 * i + 1; c = 2 * i + 2; d = 2 * i + 3
    if (i == n - 1) { c = 1; d = 0 }
    print 3, a, b, d; print 3, a, d, c } }' >m3.off
run 1 m3.off 'orient' -- m3.off out.off -n 100 --repair no
run 0 -- m3.off good.off -n 200

# --- the number of samples
run 1 torus.off 'at least 7' 'genus 1' -- torus.off out.off -n 6
for n in 3 0 -7 300000001 3000000000 1000000000000 99999999999999999999999; do
  run 1 torus.off 'from 4 to 300000000' -- torus.off out.off --samples $n
done
run 1 torus.off 'times oversampling' -- torus.off out.off -n 300000000 --sampling elimination
if [ "$(awk '/^MemTotal/ { print $2 }' /proc/meminfo)" -lt 290000000 ]; then
  run 1 torus.off 'memory' -- torus.off out.off -n 300000000 --sampling elimination --oversampling 1
fi

# --- outputs that cannot be written: said before the work, so a missing input does not matter
mkdir folder
run 5 nowhere/o.off 'no directory' -- torus.off nowhere/o.off
run 5 folder.off 'is a directory' -- torus.off folder.off
run 5 torus.off/o.off 'cannot be written' -- torus.off torus.off/o.off
run 5 /proc/o.off 'cannot be written' -- torus.off /proc/o.off
run 5 o.xyz 'does not end in' -- torus.off o.xyz
run 5 folder/ 'does not end in' -- torus.off folder/
run 5 nowhere/o.off 'no directory' -- missing.off nowhere/o.off
ln -s nowhere/o.off lost.off && run 5 lost.off 'no directory' -- torus.off lost.off
ln -s loop.off loop.off && run 5 loop.off 'symbolic links' -- torus.off loop.off
expect 'a link that leads nowhere stays' [ -L lost.off ]
run 5 nowhere/r.json 'no directory' -- torus.off out.off --report nowhere/r.json
run 5 nowhere/c.ply 'no directory' -- torus.off out.off --cells nowhere/c.ply
run 5 nowhere/s.ply 'no directory' -- torus.off out.off --samples-out nowhere/s.ply
run 5 c.off 'does not end in' -- torus.off out.off --cells c.off
run 5 s.xyz 'does not end in' -- torus.off out.off --samples-out s.xyz
run 5 nowhere/f.vtp 'no directory' -- torus.off out.off --fields nowhere/f.vtp
for f in f.ply f.off f.xyz f; do
  echo old >$f
  run 5 $f 'does not end in .vtp' -- torus.off out.off --fields $f
  expect "$f stays as it was" [ "$(cat $f)" = old ]
done
if [ "$(id -u)" -ne 0 ]; then
  mkdir locked && chmod a-w locked
  run 5 locked/o.off 'denied' -- torus.off locked/o.off
  echo old >fixed.off && chmod a-w fixed.off
  run 5 fixed.off 'denied' -- torus.off fixed.off
  cp torus.off secret.off && chmod a-r secret.off && bad secret.off 'denied'
fi
# numbers that the format has not; as text it has
awk 'NR > 2 && NR <= 802 { print $1 * 1e60, $2 * 1e60, $3 * 1e60; next } 1' torus.off >huge.off
run 5 huge.stl '--ascii' -- huge.off huge.stl -n 100 --iterations 2
expect 'nothing is written' [ ! -e huge.stl ]
run 0 -- huge.off huge.stl -n 100 --iterations 2 --ascii
# the disk is full when the report is written: the mesh does not appear either
if [ -e /dev/full ]; then
  run 5 /dev/full 'cannot be written' -- torus.off out.off -n 100 --iterations 2 --report /dev/full
fi

finish
