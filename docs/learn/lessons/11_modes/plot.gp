# Two rods released in the shape of their slow mode, at a small amplitude and at fifty times that.
set terminal svg size 720,600 font "sans,13" background "white"
set output "out/modes.svg"
set datafile separator ","
set grid lc rgb "#dddddd"
set key outside right
set multiplot layout 2,1
set xlabel "t [s]"
set ylabel "angle / initial shoulder angle"
do for [size in "small large"] {
  set title size
  first = size eq "small" ? 0.02 : 1.0
  plot "out/".size.".csv" using "t[s]":(column("q/shoulder[rad]") / first) with lines lw 2 title "shoulder", \
       "out/".size.".csv" using "t[s]":(column("q/elbow[rad]") / first) with lines lw 2 title "elbow"
}
