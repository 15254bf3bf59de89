#include "tools/report/style.hpp"

#include <fmt/format.h>

#include "tools/plot/plot.hpp"

namespace casimir::tools {
namespace {

constexpr const char* kLight =
    "--ink:#1b1d21;--paper:#fff;--soft:#5b616b;--line:#dcdfe4;--panel:#f5f6f8;--link:#0a58a8;"
    "--proved:#0b6b3a;--refuted:#a4161a;--undecided:#7a5200;";
constexpr const char* kDarkStyle =
    "--ink:#e6e6e6;--paper:#16181c;--soft:#a3a9b3;--line:#363a41;--panel:#1f2227;--link:#7db7ff;"
    "--proved:#5fd38d;--refuted:#ff8a80;--undecided:#ffcf66;";

constexpr const char* kRules = R"(
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%;text-size-adjust:100%}
body{font:16px/1.5 "Source Serif 4","STIX Two Text",Charter,Georgia,"Times New Roman",serif;
 color:var(--ink);background:var(--paper);max-width:54rem;margin:0 auto;padding:1rem 1.1rem 4rem;
 overflow-wrap:break-word}
h1{font-size:1.9rem;line-height:1.2;margin:.6rem 0 .2rem}
h2{font-size:1.3rem;margin:2.6rem 0 .6rem;padding-top:.8rem;border-top:1px solid var(--line)}
h3{font-size:1.02rem;margin:1.4rem 0 .35rem}
p{margin:.5rem 0}
a{color:var(--link)}
small,.soft,figcaption,.time,.kind,.on,.label{color:var(--soft)}
small{font-size:.85em}
code,pre,.name{font-family:ui-monospace,"DejaVu Sans Mono",Menlo,Consolas,monospace;font-size:.88em}
math{font-family:"Latin Modern Math","STIX Two Math","Cambria Math","TeX Gyre Termes Math","DejaVu Math TeX Gyre",math}
.vector{font-weight:bold}
nav ul{list-style:none;display:flex;flex-wrap:wrap;gap:.1rem 1.1rem;margin:.8rem 0;padding:0}
.badge{display:inline-block;border:1.5px solid currentColor;border-radius:.3rem;padding:0 .5rem;
 font-weight:600}
.proved>.verdict,.badge.proved,td.proved{color:var(--proved)}
.refuted>.verdict,.badge.refuted,td.refuted{color:var(--refuted)}
.undecided>.verdict,.badge.undecided,td.undecided{color:var(--undecided)}
.scroll{overflow-x:auto;overflow-y:hidden;max-width:100%}
.display{margin:.5rem 0 .5rem 1rem}
.equations{display:grid;grid-template-columns:auto minmax(0,1fr);gap:.4rem .5rem;margin:.4rem 0 .6rem 1rem;
 align-items:baseline}
.equations.stacked{grid-template-columns:minmax(0,1fr);gap:0}
.stacked>.right{margin-left:1.5rem;margin-bottom:.6rem}
.equations>div{overflow-x:auto;overflow-y:hidden;padding:.12rem 0}
.equations>.right{padding-left:1.6rem;text-indent:-1.6rem}
.equations .on{white-space:normal;padding-left:.8em}
.claims{list-style:none;margin:.3rem 0;padding:0}
.claim{display:grid;grid-template-columns:7rem 9.5rem minmax(0,1fr) auto;gap:.05rem .8rem;
 padding:.45rem 0;border-bottom:1px solid var(--line);break-inside:avoid}
.verdict{font-weight:600;white-space:nowrap}
.time{white-space:nowrap;font-size:.85em;font-variant-numeric:tabular-nums}
.evidence{grid-column:2/-1;font-size:.9em;color:var(--soft)}
.evidence .label{font-style:italic}
table{border-collapse:collapse;margin:.5rem 0;font-variant-numeric:tabular-nums;font-size:.88em}
th,td{padding:.2rem .65rem;text-align:right;white-space:nowrap;border-bottom:1px solid var(--line);vertical-align:top}
th{font-weight:600;border-bottom-color:var(--soft)}
th:first-child,td:first-child,.words th,.words td,.words2 :is(th,td):is(:nth-child(2),:last-child){
 text-align:left}
.words :is(th,td),.words2 td:last-child,th{white-space:normal}
th:first-child,td:first-child{padding-left:0}
tr.own td:first-child{font-weight:600}
tr.wrong td{color:var(--refuted)} tr.other td{color:var(--soft)}
figure{margin:1rem 0;break-inside:avoid}
figure{position:relative}
figure svg{display:block;width:100%;height:auto;max-width:38rem;margin:0 auto}
figure.told svg{touch-action:pan-y;cursor:crosshair}
.tip{position:absolute;pointer-events:none;background:var(--paper);border:1px solid var(--line);
 border-radius:.3rem;padding:.1rem .45rem;font-size:.85rem;white-space:nowrap;max-width:100%}
.back{position:absolute;right:.2rem;top:.2rem}
button,input{font:inherit;color:var(--ink);background:var(--panel);border:1px solid var(--line);
 border-radius:.3rem;padding:.1rem .6rem}
input[type=range]{accent-color:var(--link);padding:0;width:100%}
.controls label{display:grid;grid-template-columns:4.5rem minmax(0,1fr) 9.5rem;gap:.6rem;align-items:center}
.controls label span{overflow-x:auto}
input.wrong{border-color:var(--refuted);color:var(--refuted)}
#live-duration{width:8rem}
#section-canvas{display:block;width:100%;max-width:38rem;aspect-ratio:4/3;margin:0 auto;cursor:crosshair}
.cards{list-style:none;margin:.5rem 0;padding:0;display:grid;gap:.8rem;
 grid-template-columns:repeat(auto-fill,minmax(min(24rem,100%),1fr))}
.card{display:grid;grid-template-columns:7.5rem minmax(0,1fr);gap:.8rem;border:1px solid var(--line);
 border-radius:.4rem;padding:.6rem .8rem}
.card h3{margin:0} .card p{margin:.15rem 0}
.card svg{width:100%;height:auto} [hidden]{display:none!important}
figcaption{font-size:.9em;text-align:center;margin-top:.3rem}
.pair{display:grid;align-items:start;grid-template-columns:repeat(auto-fit,minmax(min(17rem,100%),1fr));gap:0 1rem}
details{margin:.6rem 0} summary{cursor:pointer;color:var(--link)}
pre{background:var(--panel);border:1px solid var(--line);border-radius:.3rem;padding:.6rem .8rem;
 overflow-x:auto;line-height:1.4;white-space:pre}
dl{display:grid;grid-template-columns:minmax(6rem,auto) minmax(0,1fr);gap:.2rem 1rem;margin:.5rem 0}
dt{color:var(--soft)} dd{margin:0}
.notes{background:var(--panel);border-left:4px solid var(--undecided);padding:.4rem .9rem}
footer{margin-top:3rem;border-top:1px solid var(--line);color:var(--soft);font-size:.9em}
@media (max-width:40rem){
 h1{font-size:1.5rem}
 .equations,.display{margin-left:0}
 .claim{grid-template-columns:auto 1fr auto}
 .claim .name,.evidence{grid-column:1/-1}
 .claim .kind{justify-self:start}
 .claim .name{grid-row:2}
 .less{display:none}
 table{font-size:.76em} th,td{padding:.2rem .3rem}
 td small{display:block} td:first-child{white-space:normal}
}
)";

constexpr const char* kPrint = R"(
@page{margin:16mm}
body{font-size:10.5pt;max-width:none;padding:0}
nav,.screen{display:none}
a{color:inherit;text-decoration:none}
h2,h3{break-after:avoid}
h2{margin-top:1.6rem}
pre{white-space:pre-wrap}
.scroll,.equations>div{overflow:visible}
table{font-size:8pt} th,td{padding:.12rem .4rem} tr{break-inside:avoid}
figure svg{max-width:120mm}
details::details-content{content-visibility:visible;display:block;height:auto}
)";

}  // namespace

std::string page_style() {
  const std::string light =
      fmt::format(":root{{color-scheme:light dark;{}{}}}", kLight, plot_variables(false));
  const std::string dark =
      fmt::format("@media screen and (prefers-color-scheme:dark){{:root{{{}{}}}}}", kDarkStyle,
                  plot_variables(true));
  return light + "\n" + dark + kRules + "@media print{" + kPrint + "}\n";
}

}  // namespace casimir::tools
