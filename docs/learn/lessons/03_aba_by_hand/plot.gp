# Angle of the shoulder with a free and with a locked elbow, and the two parabolas by hand.
set terminal svg size 680,380 font "sans,13" background "white"
set output "out/fall.svg"
set datafile separator ","
set grid lc rgb "#dddddd"
set key bottom left
set xlabel "t [s]"
set ylabel "shoulder [deg]"
set xrange [0:0.3]
set yrange [30:92]
free(t) = t < 0.2 ? 90 - 0.5 * 25.226 * t**2 * 180 / pi : NaN
locked(t) = t < 0.2 ? 90 - 0.5 * 14.715 * t**2 * 180 / pi : NaN
plot "out/free.csv" using "t[s]":(column("q/shoulder[rad]") * 180 / pi) with lines lw 2 lc 7 title "run, elbow free", \
     free(x) lc 7 dt 2 title "by hand, 9/7 g/l", \
     "out/locked.csv" using "t[s]":(column("q/shoulder[rad]") * 180 / pi) with lines lw 2 lc 6 title "run, elbow locked", \
     locked(x) lc 6 dt 2 title "by hand, 3/4 g/l"
