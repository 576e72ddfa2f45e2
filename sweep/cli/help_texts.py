"""The texts of --help: what each verb does, with examples."""

ABOUT = "Which printed infill absorbs the most energy per gram?"
EXAMPLES = """examples:
  crumple new bumper                            write bumper.toml, a config to be changed
  crumple run armor --dry-run                   how many cases, how long, how much disk
  crumple run armor                             simulate; after a stop, the same command continues
  crumple run armor --error-bars                also estimate the error of each number, and ties
  crumple run armor --part 2/16                 the second of sixteen parts, as of a job array
  crumple run armor --scheduler tcp://host:8786 --wait "2 h"    on a Dask cluster
  crumple run armor --spread                    also show what uncertain numbers change
  crumple run which_way --screen 1              crush one cell of each, then the best of each
  crumple optimize search --budget "1.2 g"      seek the best design within a budget
  crumple warm                                  compile the kernels before the first run
  crumple status results/armor.h5               what is done, what failed and why
  crumple verify results/armor.h5               is the file whole, do its numbers come out again?
  crumple merge all.h5 results/armor.1-of-2.h5 results/armor.2-of-2.h5    parts of a sweep
  crumple rank results/armor.h5 --budget "20 g" "2 oz" --panel "100 mm" "50 mm"
  crumple show results/armor.h5                 the ids of all cases
  crumple show results/armor.h5 1               pictures of the best design
  crumple show results/armor.h5 7a85            pictures of the case whose id begins with 7a85
  crumple export results/armor.h5 7a85 --to part.stl      to print; also .3mf .svg .dxf .csv .gif
  crumple report results/armor.h5               one page with sliders: results/armor.html
  crumple accuracy accuracy/impact              error against run time, method by method
  crumple materials                             the materials, their numbers and sources
  crumple card infills --to card.inp            the infills as materials for CalculiX, Abaqus
  crumple published                             predictions beside what was measured
  crumple schema > crumple.schema.json          for editors: all keys and their values
  crumple completion bash                       let the shell complete words: see its --help

armor, search and accuracy/impact are examples that come with Crumple; your own is a file: mine.toml

exit status: 0 done, also if no design meets the requirements; 1 some cases failed, or interrupted;
2 wrong config, file or arguments
"""
VERIFY = """Read everything that a results file holds against its checksums, compute the id of every
stored case anew, and simulate some of the cases again. The exit status is 1 if anything differs."""
CONFIG = "TOML file with the case and its [grid], or the name of an example"
RUN = """Simulate every case of CONFIG that the results file does not hold yet, then rank.
Finished cases are never lost and never computed twice: after a stop or a kill, or after an
extension of the grid, run the same command again. Rows of an older model stay until --renew
computes them again. With --error-bars every design runs again with half the elements and again with
half the steps: about twice the work. With --spread the five best designs of each ranking run again
with every uncertain number at both ends of its range (crumple materials lists them; friction from
0.2 to 0.9), and a table shows how far their values move and whether their order changes. With
--screen N a design that is pressed along its cells is first crushed as one cell, a tube, and only
the N best of each infill run as a whole; a table shows estimates beside results."""
OPTIMIZE = """Search for the best design among those that the table [search] of CONFIG allows:

  [search]
  "lattice.kind" = ["square", "hex"]                               one of a list
  "lattice.cells_x" = {from = 2, to = 8}                           whole numbers
  "lattice.wall_thickness" = {from = "0.4 mm", to = "1.6 mm"}      or lattice.mass

The best is what rank lists first: most energy until densification, or up to --allowed-force, or the
best of --by, among the designs that fulfil [require] or its options. If none does, the nearest are
listed. With a budget, walls are as thick as it allows at most. Every design is a row of the results
file; after a stop, the same command with the same seed continues, also with more --evaluations. Six
designs run at a time after the first sixteen: more workers do not help. The three best, without
near duplicates, are simulated again with twice the elements, with walls 5 % thinner and thicker,
and with other imperfections, in a results file of their own, and listed with their spread."""
ACCURACY = """Simulate a sweep over numerical settings, then print error against run time: a table,
the observed orders, the cheapest settings below 1 % and below 0.1 %, and a figure. The reference is
the limit to which the finest settings of the method of highest order converge. Cases that differ in
anything other than numerical settings are studied separately. A method is a choice of
solver.integrator, solver.element, contact.model and the like; solver.time_step, .load_steps,
.step_error and lattice.nodes_per_wall refine it."""
WARM = """Compile the kernels now, so that the next run starts at once; otherwise the first run
compiles them. It takes a minute or two, or three by the stock compiler (CRUMPLE_COMPILER),
and again after an update of Crumple or of its packages. The code is kept in CRUMPLE_CACHE_DIR, else
in the cache folder of the user, ~/.cache/crumple on Linux: one call serves all machines of a
cluster that share this folder and have the same processor."""
RANK = """List the designs that absorb the most energy, one table for each loading scene.
Budgets, panel and requirements are taken from [rank] and [require] in the config, unless they are
given here ("none" drops a requirement); --by alone ranks single specimens of any mass. Designs that
fail a requirement are not ranked; notes say how many within the budget fail which. If all
of them fail, the nearest one is named: the one whose worst miss, in percent of the limit, is the
smallest. The exit status is then 0, as the question is answered; it is 1 if some cases failed."""
RANK_EXAMPLES = """examples:
  crumple rank F.h5                                         as [rank] in the config says; else J/g
  crumple rank F.h5 --budget "25 g" "2 oz"                  two budgets
  crumple rank F.h5 --budget "1 oz" --panel "4 in" "2 in"   a panel of at most an ounce
  crumple rank F.h5 --allowed-force "50 N"                  energy until the force exceeds 50 N
  crumple rank F.h5 --max-force "60 N" --max-mass "2 g"      designs that fulfil both
  crumple rank F.h5 --allowed-force "2 kN" --per panel      force of the whole panel
  crumple rank F.h5 --by specific_absorption_J_per_g        most J/g, whatever the mass
  crumple rank F.h5 --by peak_force_N --top 3               least force first
  crumple rank F.h5 --csv > ranking.csv
  crumple rank F.h5 --out results/armor                     tables and figures in a folder
  crumple rank F.h5 --out results/armor --drop-height "1 m" cushion curves too
"""
NEW = """Write a config with comments that runs as it is: a crush, a drop of a rigid striker, or a
dead load. An existing file is not overwritten. Beside it is written crumple.schema.json, the JSON
schema of all keys, which its first line names: editors that know TOML complete and mark keys."""
SCHEMA = """Print the JSON schema of a config: all keys, what they mean, what is allowed. Editors
that know TOML complete and mark the keys of a config that begins with #:schema and the name of such
a file; crumple new writes both."""
COMPLETION = """Print what a shell needs to complete the words of crumple: verbs, options, examples,
results files, columns and ids. To use it:
  bash   eval "$(crumple completion bash)"             in ~/.bashrc
  zsh    eval "$(crumple completion zsh)"              in ~/.zshrc, after compinit
  fish   crumple completion fish > ~/.config/fish/completions/crumple.fish"""
SHOW = """Draw one case: force against strain, the parts of its energy, and six deformed shapes.
A CASE of at most three digits is a number in the ranking that rank prints with the same options: of
the first scene, or of --scene, within the first budget. Without CASE: list the ids and the designs
of all cases."""
SHOW_EXAMPLES = """examples:
  crumple show F.h5                                         the ids of all cases
  crumple show F.h5 a44d                                    the case whose id begins with a44d
  crumple show F.h5 1                                       the first that rank lists
  crumple show F.h5 2 --budget "25 g" --allowed-force "60 N"    the second of that ranking
"""
EXPORT = """Write one case as a file for another program, in the format that its ending names:
  .stl .3mf     the print as a closed body, as heavy as the ranking says; thick sheets are a few
                per cent lighter
  .svg .dxf     its outline, in mm
  .csv          the curves: travel, force, strain, stress, energies
  .vtkhdf       the stored shapes as a grid that moves, for ParaView 5.12 and later
  .gif          the crush as a moving picture
A file of that name is replaced, and a folder that is missing is made. With --panel: the whole
specimens that rank counts for these two lengths, side by side along the first and one behind the
other along the second. A CASE of at most three digits is a number in the ranking that rank prints
with the same options; --panel is then both the panel that is ranked and the one that is written.
A .3mf has two kinds: "lattice", the walls themselves, to be printed with
100 % infill; "settings", a solid block with the pattern, the per cent and the line width with which
a slicer draws the lattice: one of lattice.slicer, or of regular square, diamond, triangle, kagome
or hex cells."""
EXPORT_EXAMPLES = """examples:
  crumple export F.h5 a44d --to part.stl
  crumple export F.h5 a44d --to bumper.3mf --panel "100 mm" "50 mm"
  crumple export F.h5 a44d --to block.3mf --kind settings
  crumple export F.h5 a44d --to crush.gif
  crumple export F.h5 1 --budget "25 g" --panel "100 mm" "50 mm" --to first.stl
"""
REPORT = """Write one HTML page that needs no network: the best design; sliders for budget, panel
and allowed force, which rank again; energy over mass, with drawings; curves, moving shapes and
energies of chosen designs; failures and origin. It starts with the budgets and the panel of [rank]
in the config. Without scripts it shows the tables of that ranking."""

MATERIALS = """Without WORD: a table of the materials that come with Crumple. With names, also of
your own .csv files: all that their files state, with sources. With the word plot: their curves of
stress over strain, in materials.png. With the word fit: the material of your own test of a printed
strip or puck, loaded, unloaded and loaded again, as a .csv file for material.name, with a picture.
The file is the export of a testing machine as it is: time, strain or displacement (with --gauge),
stress or force (with --area). Whatever is missing in it is requested, with the option to give it.
configs/materials/README.md says how to test."""
MATERIALS_EXAMPLES = """examples:
  crumple materials                                         all of them, as a table
  crumple materials cheetah                                 one in full
  crumple materials plot                                    all curves, in materials.png
  crumple materials plot cheetah mine.csv --out two.png     two of them
  crumple materials fit coupon.csv --out mine.csv           curve, loss and softening
  crumple materials fit pull.csv --gauge "33 mm" --area "8 mm^2" --density "1210 kg/m^3"
  crumple materials fit puck.csv --gauge "10 mm" --area "314 mm^2" --test pressed --units force=kN
"""

CARD = """Print the effective material of each infill of CONFIG, as if it had no end: moduli, shear
modulus and Poisson's ratio in its plane, the modulus along its walls, the stress at which its
walls buckle, and its density. Walls are linear; perimeters and solid layers are left out. --to
writes the nine elastic constants, the density and the axes as text that CalculiX and Abaqus read
(.inp: N, mm, t, MPa), or all of it as a table in SI (.csv)."""
PUBLISHED = """Print predictions of published crushes, and of your own, beside the measured values:
what is open, the predicted range over it, the measured value with its scatter, inside or not. The
predictions are stored; --run simulates them again, into results/published/, and says which do not
come out (exit status 1; also if a case has not converged). ROW: words of the rows to print, such as
the name of a source; then also the config and the measure of each row are printed.
With --add: put your own crush into a table of your own, published.csv. CONFIG varies in its [grid]
what you do not know, such as friction. Its prediction is stored first; the measured value, with a
unit, may be given now or by the same command later. Of a curve, a csv file with the columns
displacement_mm and force_N, the measure is taken up to the simulated stroke."""
PUBLISHED_EXAMPLES = """examples:
  crumple published                                         the table
  crumple published ding                                    one source
  crumple published --out results/published                 also as a picture and as Markdown
  crumple published --run square                            simulate some rows again
  crumple published --add mine.toml                         predict your own crush
  crumple published --add mine.toml --measured "0.12 +- 0.02 J" --source "my press"
  crumple published --add mine.toml --measure plateau_stress_iso_Pa --measured curve.csv
"""

MERGE = """Bring the rows of results files into one, such as the files of the parts of a sweep that
ran as a job array (run --part K/N). Of two rows of a case, the one in the later file stays."""
