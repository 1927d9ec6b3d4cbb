% MAT-files beside the JSON of the same sheets: every number the same, to the last bit, which Octave's
% jsondecode gets wrong in one number of ten.
%   octave mat_test.m NAME.mat FOLDING.json SPRINGS.json CANDIDATE.json NAME.fold [NAME.mat ...]
% FOLDING is of `fold --json` or `replay --json`, SPRINGS of `actuators --json`, CANDIDATE of `export`.
1;

function same = are_same(one, other)
  if (isfloat(one) && isfloat(other))
    same = isequal(size(one), size(other)) && ...
           all(((isnan(one) & isnan(other)) | abs(one - other) <= eps(one))(:));
  else
    same = isequaln(one, other);
  end
end

function check(what, one, other)
  global failures
  if (! are_same(one, other))
    printf("FAILED: %s\n", what);
    failures++;
  end
end

function labels = labels_of(vertices)
  labels = arrayfun(@(v) sprintf("A%d", v), vertices, "UniformOutput", false);
end

% null is NaN among numbers.
function number = number_of(value)
  number = value;
  if (isempty(value)) number = NaN; end
end

function check_mesh(m, fold, candidate)
  check("vertices", m.vertices_mm, fold.vertices_coords);
  check("panels", m.panels, fold.faces_vertices + 1);
  check("facets", sortrows(sort(m.facets, 2)), sortrows(sort([m.panels; m.holes], 2)));
  for h = 1:rows(m.holes)
    check("a hole is no panel", ismember(sort(m.holes(h, :)), sort(m.panels, 2), "rows"), false);
  end
  shifts = zeros(size(m.vertices_mm));
  for [shift, vertex] = candidate.pattern.displacements_mm
    shifts(str2double(vertex(2:end)), :) = shift';
  end
  check("shifts", m.shifts_mm, shifts);
end

function check_joints(m, folding)
  d = folding.diagonals;
  check("diagonals", labels_of(m.diagonals), [{d.from}; {d.to}]');
  check("holes of diagonals", m.hole_row_column(m.diagonal_hole, :), [d.hole]');
  for k = 1:numel(d)
    check("ends in the hole", all(ismember(m.diagonals(k, :), m.holes(m.diagonal_hole(k), :))), true);
  end
  c = folding.creases;
  check("creases", labels_of(m.creases), [{c.from}; {c.to}]');
  check("mountains and valleys", m.crease_assignment == 1, strcmp({c.assignment}, "valley")');
end

function check_histories(m, folding, fold)
  check("samples", m.pilot_deg, [0; folding.samples_deg]);
  d = folding.diagonals;
  check("lengths", m.length_mm, [[d.flat_mm]; [d.length_mm]]);
  check("rates", m.rate_mm_per_deg, [zeros(1, numel(d)); [d.slope_mm_per_deg]]);
  c = folding.creases;
  check("fold angles", m.fold_angle_deg, [zeros(1, numel(c)); [c.fold_angle_deg]]);
  check("pilot", abs(m.fold_angle_deg(:, m.pilot_crease) - m.pilot_deg) < 1e-9, true(size(m.pilot_deg)));
  flat = [m.vertices_mm, zeros(rows(m.vertices_mm), 1)];
  check("flat sheet", squeeze(m.folded_vertices_mm(1, :, :)), flat);
  check("states", size(m.folded_vertices_mm), [numel(m.pilot_deg), size(flat)]);
  for frame = fold.file_frames'
    row = find(m.pilot_deg == frame.misalign_pilot_deg);
    check("a folded sheet", squeeze(m.folded_vertices_mm(row, :, :)), frame.vertices_coords);
  end
  % By itself: both ends of a diagonal are as far apart as it is long.
  for k = 1:numel(d)
    ends = m.folded_vertices_mm(:, m.diagonals(k, :), :);
    far = sqrt(sum((ends(:, 1, :) - ends(:, 2, :)) .^ 2, 3));
    check("ends of a diagonal", max(abs(far - m.length_mm(:, k))) < 1e-8, true);
  end
end

function check_springs(m, springs)
  s = m.springs;
  check("stations of springs", m.pilot_deg, springs.history.pilot_deg);
  for key = {"energy_n_mm", "moment_n_mm", "mechanical_advantage"}
    check(key{1}, s.(key{1}), springs.history.(key{1}));
  end
  check("forces", s.force_n, [springs.forces.history_n]);
  check("stiffness", s.stiffness_n_per_mm, springs.stiffness_n_per_mm);
  check("stroke limit", s.stroke_limit, number_of(springs.stroke_limit));
  check("weakest", s.weakest.moment_n_mm, springs.weakest.moment_n_mm);
  few = labels_of(m.diagonals(s.few.diagonals, :));
  check("few", strcat(few(:, 1), "-", few(:, 2)), springs.few.diagonals);
  check("share of few", s.few.share, springs.few.share);
  check("proof of few", s.few.proven, springs.few.proven);
  check("energy", max(abs(s.stiffness_n_per_mm / 2 * sum((m.length_mm - m.length_mm(1, :)) .^ 2, 2) ...
                          - s.energy_n_mm)) < 1e-12 * max(s.energy_n_mm), true);
  check("moment", max(abs(sum(s.moment_by_n_mm, 2) - s.moment_n_mm)) < 1e-12 * max(s.moment_n_mm), true);
end

function check_verdict(m, candidate)
  for [value, key] = candidate.verdict
    if (strcmp(key, "where"))
      check("where", isempty(value) && isempty(m.verdict.where) || strcmp(value, m.verdict.where), true);
    else
      check(key, m.verdict.(key), number_of(value));
    end
  end
  check("metrics", numel(fieldnames(m.metrics)), numel(fieldnames(candidate.metrics)));
  for [value, key] = candidate.metrics
    check(key, m.metrics.(key), number_of(value));
  end
  if (isfield(candidate, "draw"))
    check("draw", m.draw, int64(candidate.draw));
    check("campaign", m.campaign, candidate.campaign);
  end
  check("readme", ischar(m.readme) && index(m.readme, "length_mm") > 0, true);
end

global failures = 0;
names = argv();
for k = 1:5:numel(names)
  m = load(names{k});
  json = cellfun(@(name) jsondecode(fileread(name)), names(k + 1:k + 4), "UniformOutput", false);
  [folding, springs, candidate, fold] = json{:};
  check_mesh(m, fold, candidate);
  check_joints(m, folding);
  check_histories(m, folding, fold);
  check_springs(m, springs);
  check_verdict(m, candidate);
end
printf("%d files, %d failures\n", floor(numel(names) / 5), failures);
if (failures > 0 || numel(names) == 0) exit(1); end
