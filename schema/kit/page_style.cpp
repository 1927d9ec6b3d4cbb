#include "schema/kit/page_style.hpp"

namespace misalign::schema {
namespace {

// Colours are those of schema/report/page.css; beside them stand the edges of folded panels, and
// the saturation and lightness of rows.
constexpr const char* kColours = R"css(
:root{color-scheme:light;
--ground:#f4f5f7;--card:#ffffff;--ink:#1a2230;--ink-soft:#56606f;--line:#d5dae1;--grid:#e8ebef;
--accent:#0067a8;--accent-ink:#ffffff;--pick:#e0690b;--warn:#a33c00;
--mountain:#c8321f;--valley:#0067a8;--edge:#2c3542;--grows:#00795c;
--panel-front:#f3e7cb;--panel-back:#7f93b8;--panel:#fbf8f1;--panel-edge:#2c3542;--row-fill:60%,82%}
@media screen and (prefers-color-scheme:dark){:root{color-scheme:dark;
--ground:#12161d;--card:#1a2029;--ink:#e8ecf2;--ink-soft:#a3aebd;--line:#364150;--grid:#28313d;
--accent:#6cb8f0;--accent-ink:#0b1a27;--pick:#ffa04d;--warn:#ffb27a;
--mountain:#ff7c66;--valley:#68b5f2;--edge:#c7d0dc;--grows:#35cfa0;
--panel-front:#d8c9a2;--panel-back:#5d74a3;--panel:#222a35;--row-fill:40%,28%}}
)css";

constexpr const char* kStyle = R"css(
*{box-sizing:border-box}
body{margin:0;background:var(--ground);color:var(--ink);font:15px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Noto Sans","DejaVu Sans",sans-serif}
main{max-width:1080px;margin:24px auto;padding:28px 36px 36px;background:var(--card);border:1px solid var(--line);border-radius:10px}
h1,h2{line-height:1.2;font-weight:650;letter-spacing:-.01em}
h1{font-size:30px;margin:0}
h2{font-size:19px;margin:1.6em 0 .5em}
p{margin:.5em 0;max-width:90ch}
code{font:.87em/1.5 ui-monospace,"SF Mono",Menlo,Consolas,"DejaVu Sans Mono",monospace;overflow-wrap:anywhere}
.quiet,figcaption{color:var(--ink-soft)}
table{border-collapse:collapse;margin:.5em 0;font-variant-numeric:tabular-nums}
th,td{padding:.3em .75em;text-align:left;vertical-align:top}
th{color:var(--ink-soft);font-weight:500;line-height:1.25;vertical-align:bottom}
td{border-top:1px solid var(--line)}
th:first-child,td:first-child{padding-left:0}
th:last-child,td:last-child{padding-right:0}
td.n,th.n{text-align:right}
table.beside td,table.numbers td{white-space:nowrap}
table.beside{display:inline-table;margin-right:2.5em;vertical-align:top}
figure{display:inline-block;margin:0 0 1em;vertical-align:top}
figure.wide{width:100%}figure.half{width:49%}figure.third{width:32%}
figcaption{margin-top:.3em}
figure svg{display:block;max-width:100%;max-height:60mm;overflow:visible}
figure.half svg{max-height:75mm}figure.wide svg{max-height:105mm}
figure svg *{stroke-width:1px;stroke-linejoin:round;vector-effect:non-scaling-stroke}
figure svg polyline{stroke-width:1.6px}
figure svg circle{fill:var(--pick);stroke:var(--card)}
figure svg text{fill:var(--ink)}
.lines{display:contents}
.lines text{paint-order:stroke;stroke:var(--panel)!important;stroke-width:3px!important}
.swatch{display:inline-block;width:1.2em;height:.8em;border:1px solid var(--ink-soft);print-color-adjust:exact}
.verdict{--says:var(--warn);display:grid;grid-template-columns:auto 1fr;gap:0 .8em;align-items:center;margin:1em 0;padding:.7em 1em;border:1px solid var(--says);border-left-width:7px;border-radius:8px;background:color-mix(in srgb,var(--says) 10%,var(--card));print-color-adjust:exact}
.verdict.passes{--says:var(--grows)}.verdict.fails{--says:var(--mountain)}
.verdict::before{content:"!";grid-row:span 2;width:1.7em;border-radius:50%;background:var(--says);color:var(--card);font-weight:700;font-size:1.25em;line-height:1.7em;text-align:center}
.verdict.passes::before{content:"✓"}.verdict.fails::before{content:"✗"}
.verdict strong{color:var(--says);font-size:1.25em;line-height:1.3}
.verdict p{grid-column:2;margin:0;max-width:none}
.requirements{width:100%}
.requirements td:first-child{white-space:nowrap;font-weight:650;color:var(--grows)}
.requirements td:first-child::before{content:"✓ "}
.requirements .fail{background:color-mix(in srgb,var(--mountain) 10%,var(--card));print-color-adjust:exact}
.requirements .fail td:first-child{color:var(--mountain)}
.requirements .fail td:first-child::before{content:"✗ "}
.requirements td:first-child,.requirements th:first-child{padding-left:.5em}
.requirements td:last-child,.requirements th:last-child{padding-right:.5em}
.requirements td.left{white-space:nowrap}
.requirements th:last-child{text-align:left}
.bar{display:inline-block;width:7.5em;height:.75em;margin-right:.7em;overflow:visible}
.facts td:nth-child(2){white-space:nowrap}
.bar .range{fill:var(--grid)}
.bar .met{fill:var(--grows);fill-opacity:.3}
.bar .value{fill:var(--grows)}
.bar .limit{stroke:var(--ink);stroke-width:2px}
.fail .bar .value{fill:var(--mountain)}
.steps{list-style:none;padding:0;counter-reset:step}
.steps>li{counter-increment:step;margin:0 0 1em}
.steps>li>b:first-child::before{content:counter(step);display:inline-block;min-width:1.6em;margin-right:.5em;padding:0 .3em;border-radius:.8em;background:var(--accent);color:var(--accent-ink);text-align:center;print-color-adjust:exact}
.steps figure{margin-top:.6em}
.step{display:flex;flex-wrap:wrap;gap:0 2%;align-items:end}
@media screen and (max-width:700px){
main{margin:0;padding:18px 16px 28px;border:0;border-radius:0}
h1{font-size:26px}
table:not(.requirements,.facts){display:block;width:fit-content;max-width:100%;overflow-x:auto;margin-right:0;background:linear-gradient(to left,var(--card) 50%,transparent) right/40px 100% no-repeat local,linear-gradient(to left,var(--line),transparent) right/16px 100% no-repeat scroll}
td,th{padding:.3em .5em}
figure.half,figure.third{width:100%}
figure.wide text{font-size:1.4em}
.requirements,.requirements tbody,.requirements td,.facts,.facts tbody,.facts tr,.facts td{display:block}
.requirements thead,.facts thead{display:none}
.facts tr{padding:.4em 0;border-top:1px solid var(--line)}
.requirements tr{display:grid;grid-template-columns:repeat(3,1fr);gap:.1em .8em;padding:.7em 0;border-top:1px solid var(--line)}
.requirements .fail{margin:0 -16px;padding:.7em 16px}
.requirements td,.requirements td:first-child,.requirements td:last-child,.facts td{border:0;padding:0}
.requirements td.n{text-align:left}
.requirements td:nth-child(-n+2),.requirements td.left{grid-column:1/-1}
.requirements td[data-head]::before{content:attr(data-head);display:block;color:var(--ink-soft);font-size:13px}
.bar{display:block;width:100%;margin:.5em 0 .2em}
}
@page{size:A4;margin:12mm}
h1,h2{break-after:avoid}
h2+p{break-after:avoid;break-inside:avoid}
main{orphans:1;widows:1}p{orphans:2;widows:2}
table,tr,figure,.step,.verdict{break-inside:avoid}
thead{display:table-header-group}
@media print{
body{background:none;font-size:10.5pt;line-height:1.35}
main{max-width:none;margin:0;padding:0 .5mm;border:0}
h1{font-size:16pt}h2{font-size:13pt;margin:1em 0 .3em}
th,td{padding:.1em .6em}
p{max-width:none}code{font-size:.95em}
ul{margin:.2em 0}figure{margin:0}
}
)css";

// A sheet of 6 x 6 fits one page.
constexpr const char* kCardStyle = R"css(
td.n{white-space:nowrap}
.pair figure text{font-size:1.35em}
@media not (max-width:700px){.pair figure{width:49%}}
@page{margin:9mm}
@media print{
body{font-size:7.5pt;line-height:normal}
h1{font-size:12pt}h2{font-size:9pt;margin:.5em 0 .1em}
p{margin:.2em 0}table{margin:.2em 0}th,td{padding:0 .5em}
.verdict{margin:.4em 0;padding:.3em .8em}
.pair figure svg{max-height:46mm}
}
)css";

}  // namespace

std::string page_style(PageStyle style) {
  return std::string(kColours) + kStyle + (style == PageStyle::card ? kCardStyle : "");
}

}  // namespace misalign::schema
