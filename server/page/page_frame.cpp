#include "server/page/page_frame.hpp"

namespace skerry::server {

const char* const kPageStyle = R"css(
:root{color-scheme:light dark;--ink:#1c2430;--soft:#5b6675;--page:#fff;--line:#d9dee5;--sea:#eaf2f8;
--land:#e6dcc2;--shore:#a08c5b;--bad:#b3261e;--good:#1b7a3d;--head:#f3f5f8;
--c0:#1463b8;--c1:#c2570c;--c2:#12805c;--c3:#8b3fb5;--c4:#a3184f;--c5:#5c6b00;--c6:#00727f;
--c7:#7a5200;--c8:#5b6675}
@media screen and (prefers-color-scheme:dark){:root{--ink:#e4e9f0;--soft:#9aa7b6;--page:#12171e;
--line:#333d49;--sea:#16222e;--land:#3a3626;--shore:#8a7b50;--bad:#ff8a80;--good:#6fd08f;--head:#1b232d;
--c0:#6fb3ff;--c1:#ffa45c;--c2:#5fd3a6;--c3:#d19bf0;--c4:#ff8fb8;--c5:#cfdc6a;--c6:#63d5e0;
--c7:#e0b56a;--c8:#9aa7b6}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:1120px;padding:20px 24px 60px;background:var(--page);color:var(--ink);
font:15px/1.45 system-ui,-apple-system,"Segoe UI",Roboto,"Noto Sans",sans-serif}
h1{font-size:26px;margin:0 0 4px}
h2{font-size:19px;margin:34px 0 8px;padding-top:8px;border-top:2px solid var(--line)}
h3{font-size:16px;margin:20px 0 4px}
p{margin:4px 0 8px;max-width:80ch}
.soft{color:var(--soft)} .bad{color:var(--bad);font-weight:600} .good{color:var(--good)}
.facts{display:flex;flex-wrap:wrap;gap:4px 28px;margin:10px 0;color:var(--soft)}
.facts b{color:var(--ink);font-weight:600}
.briefing{white-space:pre-line}
nav{margin:10px 0;display:flex;flex-wrap:wrap;gap:4px 16px}
a{color:var(--c0)}
.wide{overflow-x:auto}
table{border-collapse:collapse;width:100%;font-size:14px;margin:6px 0 10px}
th,td{text-align:left;vertical-align:top;padding:4px 10px 4px 6px;border-bottom:1px solid var(--line);
overflow-wrap:anywhere}
th{background:var(--head);white-space:nowrap;overflow-wrap:normal}
.n{width:1%;text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
tr.collision td,tr.grounding td{color:var(--bad);font-weight:600}
svg{display:block;width:100%;height:auto;margin:6px 0;font:12px system-ui,"Noto Sans",sans-serif}
svg text{fill:var(--ink)}
.chart{border:1px solid var(--line)}
.sea{fill:var(--sea)} .land{fill:var(--land);stroke:var(--shore);stroke-width:.8}
.lake{fill:var(--sea);stroke:var(--shore);stroke-width:.8}
.grid{stroke:var(--line);stroke-width:.7;fill:none} .axis,.scale{stroke:var(--ink);fill:none}
.scale{stroke-width:1.6}
svg .tick{fill:var(--soft);font-size:11px} svg .name{font-weight:600}
.limit{stroke:var(--bad);stroke-dasharray:6 4;fill:none}
.curve,.way{fill:none;stroke-width:1.6;stroke-linejoin:round} .way{stroke-width:2}
.target{stroke:var(--c8);stroke-width:1.2;stroke-dasharray:5 3}
.known{stroke:var(--c4);stroke-width:.9;stroke-opacity:.8}
.c0{stroke:var(--c0)}.c1{stroke:var(--c1)}.c2{stroke:var(--c2)}.c3{stroke:var(--c3)}
.c4{stroke:var(--c4)}.c5{stroke:var(--c5)}.c6{stroke:var(--c6)}.c7{stroke:var(--c7)}
.hull{stroke:var(--page);stroke-width:.8}
.f0{fill:var(--c0)}.f1{fill:var(--c1)}.f2{fill:var(--c2)}.f3{fill:var(--c3)}.f4{fill:var(--c4)}
.f5{fill:var(--c5)}.f6{fill:var(--c6)}.f7{fill:var(--c7)}.f8{fill:var(--c8)}
svg .label,svg .time{paint-order:stroke;stroke:var(--sea);stroke-width:3px;stroke-linejoin:round}
svg .label{font-size:12.5px} svg .own{font-weight:700} svg .time{font-size:11px}
.dot{fill:var(--ink)}
.mishap circle{fill:var(--bad);stroke:#fff;stroke-width:1.5} .mishap text{fill:#fff;font-weight:700}
@media screen and (prefers-color-scheme:dark){.mishap text{fill:#12171e}}
.mark{stroke:var(--soft);stroke-width:1;stroke-dasharray:2 3;fill:none}
.mark.collision,.mark.grounding{stroke:var(--bad);stroke-width:1.6;stroke-dasharray:none}
.cursor{stroke:var(--ink);stroke-width:1;pointer-events:none}
.kinds{display:none;flex-wrap:wrap;gap:4px 14px;margin:6px 0}
.script .kinds{display:flex}
@media print{body{max-width:none;padding:0;font-size:11pt}nav,.kinds{display:none!important}
h2{break-after:avoid}h3{break-after:avoid}svg,tr{break-inside:avoid}.ship{break-inside:avoid-page}
.wide{overflow:visible}thead{display:table-header-group}table{font-size:9.5pt}
*{print-color-adjust:exact;-webkit-print-color-adjust:exact}}
@page{margin:14mm}
)css";

// A line and the time under the pointer, in all plots at once; kinds of the time line to choose.
const char* const kPageScript = R"js(
document.documentElement.classList.add('script');
const plots=[...document.querySelectorAll('svg.plot')].map(svg=>{
  const make=name=>svg.appendChild(document.createElementNS('http://www.w3.org/2000/svg',name));
  const line=make('path'),text=make('text');
  line.setAttribute('class','cursor');text.setAttribute('class','tick');
  text.setAttribute('y',svg.viewBox.baseVal.height-30);
  return {svg,line,text,left:+svg.dataset.left,right:+svg.dataset.right,end:+svg.dataset.end};
});
const two=n=>String(n).padStart(2,'0');
const clock=s=>{s=Math.floor(s);return s<3600?Math.floor(s/60)+':'+two(s%60):
  Math.floor(s/3600)+':'+two(Math.floor(s/60)%60)+':'+two(s%60)};
const show=share=>plots.forEach(p=>{
  const on=share!==null&&p.end>0,x=on?p.left+share*(p.right-p.left):0;
  p.line.setAttribute('d',on?`M${x} 22V${p.svg.viewBox.baseVal.height-20}`:'');
  p.text.textContent=on?clock(share*p.end):'';
  p.text.setAttribute('x',x+4);
});
plots.forEach(p=>{
  p.svg.addEventListener('pointermove',e=>{
    const box=p.svg.getBoundingClientRect();
    const x=(e.clientX-box.left)*p.svg.viewBox.baseVal.width/box.width;
    show(x<p.left||x>p.right?null:(x-p.left)/(p.right-p.left));
  });
  p.svg.addEventListener('pointerleave',()=>show(null));
});
document.querySelectorAll('.kinds input').forEach(box=>box.addEventListener('change',()=>
  document.querySelectorAll('#happened tbody tr.'+box.value).forEach(row=>row.hidden=!box.checked)));
)js";

}  // namespace skerry::server
